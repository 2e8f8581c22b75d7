// SPDX-FileCopyrightText: 2026 The stillpoint authors
// SPDX-License-Identifier: MIT

#include "stillpoint/motion/rigid/reprojection_refinement.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <limits>
#include <vector>

#include "motion_scene.hpp"
#include "stillpoint/core/random.hpp"

namespace stillpoint {
namespace {

using test::test_camera;

constexpr std::array<double, 8> kWide{1e6, 1e6, 1e6, 1e6, 1e6, 1e6, 1e6, 1e6};  // cutoffs that reject nothing

Vector3d random_vector(Random& random, double size) {
  return Vector3d(random.uniform(-size, size), random.uniform(-size, size), random.uniform(-size, size));
}

Pose random_pose(Random& random, double turn_rad, double length_m) {
  return test::pose_of(random_vector(random, turn_rad), random_vector(random, length_m));
}

Pose exp_of(const Vector6d& x) { return test::pose_of(x.head<3>(), x.tail<3>()); }

Vector3d random_point(Random& random) {
  return test_camera().back_project({random.uniform(50, 590), random.uniform(50, 430)}, random.uniform(1.0, 4.0));
}

/// A point that the older frame shows exactly where it is.
PointConstraint exact_point(const Vector3d& point, const Pose& reference_from_current, std::size_t frame = 0) {
  PointConstraint constraint;
  constraint.point = point;
  constraint.pixel = test_camera().project(reference_from_current * point);
  constraint.pixel_sigma = 0.6;
  constraint.depth_m = (reference_from_current * point).z();
  constraint.depth_slope = 100.0;  // 0.01 m
  constraint.frame = frame;
  return constraint;
}

PlaneConstraint exact_plane(const Vector3d& point, const Pose& reference_from_current, Random& random,
                            std::size_t frame = 0) {
  PlaneConstraint plane;
  plane.point = point;
  const Vector3d normal = random_vector(random, 1.0).normalized();
  const Vector3d along = normal.cross(random_vector(random, 1.0));  // any other point of the plane
  plane.target = reference_from_current * point + 0.1 * along;
  plane.slope = normal / 0.01;
  plane.frame = frame;
  return plane;
}

/// What x does to three errors when the current camera moves on by it, from central differences: JᵀWJ.
template <class Errors>
Matrix6d numeric_information(const Errors& errors, const Matrix3d& weight = Matrix3d::Identity()) {
  constexpr double kStep = 1e-6;
  Eigen::Matrix<double, 3, 6> jacobian;
  for (int k = 0; k < 6; ++k) {
    Vector6d x = Vector6d::Zero();
    x[k] = kStep;
    jacobian.col(k) = (errors(x) - errors(-x)) / (2 * kStep);
  }
  return jacobian.transpose() * weight * jacobian;
}

// At zero error the change of the pixel's information does not matter.
TEST(ReprojectionRefinement, PointJacobiansAreThoseOfCentralDifferences) {
  for (std::uint64_t seed = 0; seed < 100; ++seed) {
    Random random(seed);
    Pose pose = random_pose(random, 0.3, 0.3);
    PointConstraint constraint = exact_point(random_point(random), pose);
    constraint.inverse_depth_sigma = seed % 3 == 0 ? 0.0 : random.uniform(0.001, 0.3);
    if (seed % 2 == 0) constraint.depth_slope = 0;
    const PointResidual<double> here(pose, test_camera(), constraint);
    Matrix3d weight = Matrix3d::Identity();
    weight.topLeftCorner<2, 2>() << here.xx, here.xy, here.xy, here.yy;
    const Matrix6d expected = numeric_information(
        [&](const Vector6d& x) -> Vector3d {
          const PointResidual<double> moved(pose * exp_of(x).inverse(), test_camera(), constraint);
          return {moved.off_x, moved.off_y, moved.depth_error};
        },
        weight);
    const Pose before = pose;
    const Matrix6d information = refine_reprojection(span<const PointConstraint>(&constraint, 1), {},
                                                     span<Pose>(&pose, 1), span(kWide).first(1), test_camera());
    EXPECT_LT((information - expected).norm(), 1e-5 * expected.norm()) << "seed " << seed;  // of the differences
    EXPECT_TRUE(pose.isApprox(before, 1e-12)) << "no error, no step";
  }
}

TEST(ReprojectionRefinement, PlaneJacobiansAreThoseOfCentralDifferences) {
  for (std::uint64_t seed = 0; seed < 100; ++seed) {
    Random random(seed);
    Pose pose = random_pose(random, 0.3, 0.3);
    const PlaneConstraint plane = exact_plane(random_point(random), pose, random);
    const Matrix6d expected = numeric_information([&](const Vector6d& x) -> Vector3d {
      const Pose moved = pose * exp_of(x).inverse();
      return {plane.slope.dot(moved * plane.point - plane.target), 0, 0};
    });
    const Matrix6d information = refine_reprojection({}, span<const PlaneConstraint>(&plane, 1), span<Pose>(&pose, 1),
                                                     span(kWide).first(1), test_camera());
    EXPECT_LT((information - expected).norm(), 1e-5 * expected.norm()) << "seed " << seed;
  }
}

// Two constraints are worked out side by side; of an odd number one is left over.
TEST(ReprojectionRefinement, InformationIsTheSumOfEachConstraints) {
  for (std::size_t count = 1; count <= 5; ++count) {
    Random random(count);
    Pose pose = random_pose(random, 0.3, 0.3);
    std::vector<PointConstraint> points;
    std::vector<PlaneConstraint> planes;
    Matrix6d sum = Matrix6d::Zero();
    const span<const double> once = span(kWide).first(1);
    for (std::size_t i = 0; i < count; ++i) {
      points.push_back(exact_point(random_point(random), pose));
      points.back().inverse_depth_sigma = random.uniform(0.0, 0.1);
      points.back().weight = random.uniform();
      planes.push_back(exact_plane(random_point(random), pose, random));
      sum += refine_reprojection(span<const PointConstraint>(&points.back(), 1), {}, span<Pose>(&pose, 1), once,
                                 test_camera());
      sum += refine_reprojection({}, span<const PlaneConstraint>(&planes.back(), 1), span<Pose>(&pose, 1), once,
                                 test_camera());
    }
    const Matrix6d all = refine_reprojection(points, planes, span<Pose>(&pose, 1), once, test_camera());
    EXPECT_LT((all - sum).norm(), 1e-9 * sum.norm()) << count << " of each";
  }
}

/// Two older frames, points and planes in both, and an assumed pose that is off by one motion of the current camera.
struct Problem {
  std::array<Pose, 2> truth, poses;
  std::vector<PointConstraint> points;
  std::vector<PlaneConstraint> planes;

  Problem(Random& random, std::size_t point_count, std::size_t plane_count, double error) {
    Vector6d x;
    x << random_vector(random, error), random_vector(random, error);
    for (std::size_t f = 0; f < 2; ++f) {
      truth[f] = random_pose(random, 0.1, 0.1);
      poses[f] = truth[f] * exp_of(x);
    }
    for (std::size_t i = 0; i < point_count; ++i)
      points.push_back(exact_point(random_point(random), truth[2 * i / point_count], 2 * i / point_count));
    for (std::size_t i = 0; i < plane_count; ++i)
      planes.push_back(exact_plane(random_point(random), truth[2 * i / plane_count], random, 2 * i / plane_count));
  }

  Matrix6d refine(span<const double> cutoffs) {
    return refine_reprojection(points, planes, span<Pose>(poses), cutoffs, test_camera());
  }
  double error() const {
    double worst = 0;
    for (std::size_t f = 0; f < 2; ++f)
      worst = std::max({worst, test::rotation_error(poses[f], truth[f]), test::translation_error(poses[f], truth[f])});
    return worst;
  }
};

TEST(ReprojectionRefinement, RecoversAKnownMotionFromPointsFromPlanesAndFromBoth) {
  for (std::uint64_t seed = 0; seed < 100; ++seed) {
    for (const auto& [points, planes] : {std::pair{20, 0}, {0, 40}, {10, 10}}) {
      Random random(seed);
      Problem problem(random, static_cast<std::size_t>(points), static_cast<std::size_t>(planes), 0.03);
      ASSERT_GT(problem.error(), 1e-3);
      problem.refine(kWide);
      EXPECT_LT(problem.error(), 1e-8) << "seed " << seed << ", " << points << " points, " << planes << " planes";
    }
  }
}

TEST(ReprojectionRefinement, PointsWithoutAnyDepthDetermineTheMotionToo) {
  for (std::uint64_t seed = 0; seed < 20; ++seed) {
    Random random(seed);
    Problem problem(random, 60, 0, 0.005);
    for (PointConstraint& point : problem.points) {
      point.depth_slope = 0;
      point.inverse_depth_sigma = 0.001;
    }
    problem.refine(kWide);
    EXPECT_LT(problem.error(), 1e-6) << "seed " << seed;
  }
}

// Outliers of 30 px and more are 50 sigmas, beyond the cutoff: they have no weight at all, and the answer is exact.
TEST(ReprojectionRefinement, AThirdOfOutliersChangesNothing) {
  constexpr std::array<double, 8> kAnneal{12.0, 8.0, 6.0, 4.0, 4.0, 4.0, 4.0, 4.0};
  for (std::uint64_t seed = 0; seed < 100; ++seed) {
    Random random(seed);
    Problem problem(random, 60, 20, 0.003);
    for (std::size_t i = 0; i < problem.points.size(); i += 3) {
      const double angle = random.uniform(0.0, 6.28);
      problem.points[i].pixel += random.uniform(30, 100) * Vector2d(std::cos(angle), std::sin(angle));
    }
    for (std::size_t i = 0; i < problem.planes.size(); i += 3)
      problem.planes[i].target += problem.planes[i].slope.normalized() * random.uniform(0.3, 1.0);
    problem.refine(kAnneal);
    EXPECT_LT(problem.error(), 1e-6) << "seed " << seed;
  }
}

// A wrong depth counts three sigmas and pulls nothing; the pixel still does.
TEST(ReprojectionRefinement, AWrongDepthDoesNotVetoARightPixel) {
  Random random(3);
  Problem problem(random, 30, 0, 0.002);
  for (std::size_t i = 0; i < problem.points.size(); i += 2) problem.points[i].depth_m *= 0.5;
  const PointResidual<double> point(problem.truth[0], test_camera(), problem.points[0]);
  EXPECT_EQ(point.depth_slope, 0.0);
  EXPECT_NEAR(point.squared, 9.0, 1e-9);
  problem.refine(kWide);
  EXPECT_LT(problem.error(), 1e-8);
}

// With Gaussian noise and no robust weights the error's squared Mahalanobis distance is χ² with 6 degrees: mean 6,
// variance 12, so that the mean over 200 seeds is within 6 ± 4 √(12 / 200) = 6 ± 1.
TEST(ReprojectionRefinement, InformationIsTheInverseCovarianceOfTheErrors) {
  double sum = 0;
  constexpr int kSeeds = 200;
  for (std::uint64_t seed = 0; seed < kSeeds; ++seed) {
    Random random(seed);
    Problem problem(random, 60, 30, 0.0);
    for (std::size_t i = 0; i < problem.points.size(); ++i) {
      PointConstraint& point = problem.points[i];
      point.pixel += point.pixel_sigma * Vector2d(random.gaussian(), random.gaussian());
      point.depth_m += random.gaussian() / point.depth_slope;
      if (i % 3 != 0) continue;
      point.depth_slope = 0;  // these have an uncertain depth in the current frame instead
      point.inverse_depth_sigma = 0.02;
      point.point /= 1.0 + point.point.z() * point.inverse_depth_sigma * random.gaussian();
    }
    for (PlaneConstraint& plane : problem.planes)
      plane.target += plane.slope / plane.slope.squaredNorm() * random.gaussian();
    const Matrix6d information = problem.refine(kWide);
    // pose = truth · Exp(x)⁻¹
    const Pose step = problem.poses[0].inverse() * problem.truth[0];
    const Eigen::AngleAxisd turn(step.linear());
    Vector6d x;
    x << turn.angle() * turn.axis(), step.translation();
    sum += x.dot(information * x);
  }
  EXPECT_GT(sum / kSeeds, 5.0);
  EXPECT_LT(sum / kSeeds, 7.0);
}

// offᵀ (σ² I + a aᵀ)⁻¹ off, with a from central differences: how far the pixel goes by a sigma of inverse depth.
TEST(ReprojectionRefinement, ThePixelsCovarianceHasTheDepthsNoiseAlongTheEpipolarLine) {
  Random random(5);
  const auto camera = test_camera();
  for (int trial = 0; trial < 1000; ++trial) {
    const Pose pose = random_pose(random, 0.1, 0.2);
    PointConstraint point = exact_point(random_point(random), pose);
    const Vector2d off(random.uniform(-5, 5), random.uniform(-5, 5));
    point.pixel -= off;
    point.inverse_depth_sigma = trial % 3 == 0 ? 0.0 : random.uniform(0.0, 0.3);
    const double wrong_m = trial % 2 == 0 ? 0.0 : random.uniform(-0.05, 0.05);
    point.depth_m -= wrong_m;
    if (trial % 2 == 0) point.depth_slope = 0;
    const auto pixel_at = [&](double more) -> Vector2d {
      return camera.project(pose * Vector3d(point.point / (1.0 + more * point.point.z())));
    };
    constexpr double kStep = 1e-6;
    const Vector2d spread = point.inverse_depth_sigma * (pixel_at(kStep) - pixel_at(-kStep)) / (2 * kStep);
    const Eigen::Matrix2d covariance =
        point.pixel_sigma * point.pixel_sigma * Eigen::Matrix2d::Identity() + spread * spread.transpose();
    const double depth_error = wrong_m * point.depth_slope;
    const double expected = off.dot(covariance.inverse() * off) + std::min(depth_error * depth_error, 9.0);
    ASSERT_NEAR(squared_residual(point, pose, camera), expected, 1e-6 * expected) << "trial " << trial;
  }
  PointConstraint behind = exact_point({0, 0, 2}, Pose::Identity());
  behind.point.z() = -2;
  EXPECT_EQ(squared_residual(behind, Pose::Identity(), test_camera()), std::numeric_limits<double>::infinity());
}

// The camera moved by 0.1 m to the side; the point is straight ahead at 2 m. Its inverse depth, 0.5 ± 0.25 per metre,
// moves it by f b σ_ρ = 525 · 0.1 · 0.25 = 13.125 px along its row. Across the row nothing but pixel noise acts.
TEST(ReprojectionRefinement, AlongTheEpipolarLineADepthlessPointSaysLittle) {
  const auto camera = test_camera();
  const Pose aside = test::pose_of(Vector3d::Zero(), {0.1, 0, 0}), turned = test::pose_of({0, 0, 0.2}, {0, 0, 0});
  PointConstraint point;
  point.point = {0, 0, 2};
  point.inverse_depth_sigma = 0.25;
  point.pixel_sigma = 0.6;
  const Vector2d seen = camera.project(aside * point.point);
  point.pixel = seen + Vector2d(5, 0);
  EXPECT_NEAR(squared_residual(point, aside, camera), 25.0 / (0.36 + 13.125 * 13.125), 1e-9);
  point.pixel = seen + Vector2d(0, 3);
  EXPECT_NEAR(squared_residual(point, aside, camera), 9.0 / 0.36, 1e-9);
  // A rotation shows every depth in the same place: both directions count.
  for (const Vector2d& error : {Vector2d(5, 0), Vector2d(0, 5)}) {
    point.pixel = camera.project(turned * point.point) + error;
    EXPECT_NEAR(squared_residual(point, turned, camera), 25.0 / 0.36, 1e-9);
  }
}

TEST(ReprojectionRefinement, APointBehindTheCameraOrNotFiniteSaysNothing) {
  Random random(4);
  Problem problem(random, 20, 0, 0.01);
  PointConstraint bad = problem.points[0];
  bad.point.z() = -1;
  problem.points.insert(problem.points.begin(), bad);
  bad = problem.points[1];
  bad.pixel.x() = std::numeric_limits<double>::quiet_NaN();
  problem.points.insert(problem.points.begin(), bad);
  bad = problem.points[2];
  bad.point.setConstant(std::numeric_limits<double>::quiet_NaN());
  problem.points.insert(problem.points.begin(), bad);
  problem.refine(kWide);
  EXPECT_LT(problem.error(), 1e-8);
}

TEST(ReprojectionRefinement, WithoutConstraintsNothingMoves) {
  Random random(5);
  Pose pose = random_pose(random, 0.3, 0.3);
  const Pose before = pose;
  EXPECT_TRUE(refine_reprojection({}, {}, span<Pose>(&pose, 1), kWide, test_camera()).isZero());
  EXPECT_TRUE(pose.isApprox(before, 1e-12));
  PointConstraint weightless = exact_point({0, 0, 2}, test::pose_of({0, 0, 0}, {0.1, 0, 0}));
  weightless.weight = 0;
  EXPECT_TRUE(
      refine_reprojection(span<const PointConstraint>(&weightless, 1), {}, span<Pose>(&pose, 1), kWide, test_camera())
          .isZero());
  EXPECT_TRUE(pose.isApprox(before, 1e-12));
}

// (1 − s / c²)²: at half the squared cutoff a quarter; nothing at the cutoff, beyond, and for NaN.
TEST(ReprojectionRefinement, TukeysWeightFallsToNothingAtTheCutoff) {
  const detail::Tukey tukey(4.0);
  EXPECT_EQ(tukey(0.0), 1.0);
  EXPECT_EQ(tukey(8.0), 0.25);
  EXPECT_EQ(tukey(16.0), 0.0);
  EXPECT_EQ(tukey(1e9), 0.0);
  EXPECT_EQ(tukey(std::numeric_limits<double>::quiet_NaN()), 0.0);
}

}  // namespace
}  // namespace stillpoint
