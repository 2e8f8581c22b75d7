// SPDX-FileCopyrightText: 2026 The stillpoint authors
// SPDX-License-Identifier: MIT

// The solvers against hand-computed cases and OpenCV.

#include "stillpoint/motion/epipolar/fundamental_eight_point.hpp"

#include <gtest/gtest.h>
#include <opencv2/calib3d.hpp>
#include <opencv2/core/eigen.hpp>

#include <array>
#include <cmath>
#include <limits>
#include <vector>

#include "motion_scene.hpp"
#include "stillpoint/motion/epipolar/essential.hpp"
#include "stillpoint/motion/epipolar/fundamental_estimator.hpp"
#include "stillpoint/motion/epipolar/fundamental_seven_point.hpp"

namespace stillpoint {
namespace {

/// Up to sign and scale.
double difference(const Matrix3d& a, const Matrix3d& b) {
  const Matrix3d x = a / a.norm(), y = b / b.norm();
  return std::min((x - y).norm(), (x + y).norm());
}

Matrix3d true_fundamental(const Pose& pose) {
  const Matrix3d inverse = test::test_camera().matrix().inverse();
  return inverse.transpose() * skew(pose.translation()) * pose.linear() * inverse;
}

std::vector<cv::Point2d> points(const std::vector<Vector2d>& pixels) {
  std::vector<cv::Point2d> result;
  for (const Vector2d& p : pixels) result.emplace_back(p.x(), p.y());
  return result;
}

TEST(FundamentalSevenPoint, CubicRootsAreThoseOfItsFactors) {
  std::array<double, 3> roots;
  ASSERT_EQ(real_roots(1, -6, 11, -6, roots), 3u);  // (x - 1)(x - 2)(x - 3)
  std::sort(roots.begin(), roots.end());
  for (std::size_t i = 0; i < 3; ++i) EXPECT_NEAR(roots[i], static_cast<double>(i) + 1.0, 1e-12);
  ASSERT_EQ(real_roots(2, 0, 0, -16, roots), 1u);  // 2 (x³ - 8)
  EXPECT_NEAR(roots[0], 2.0, 1e-12);
  ASSERT_EQ(real_roots(0, 1, -3, 2, roots), 2u);  // (x - 1)(x - 2)
  EXPECT_EQ(real_roots(0, 1, 0, 1, roots), 0u);
  ASSERT_EQ(real_roots(0, 0, 2, -1, roots), 1u);
  EXPECT_EQ(roots[0], 0.5);
  EXPECT_EQ(real_roots(0, 0, 0, 1, roots), 0u);
  ASSERT_EQ(real_roots(1, 0, 0, 0, roots), 1u);
  EXPECT_EQ(roots[0], 0.0);
}

TEST(Fundamental, BothSolversFindTheMotionsMatrixAsOpenCvDoes) {
  for (std::uint64_t seed = 0; seed < 100; ++seed) {
    Random random(seed);
    const Pose pose = test::random_motion(random, 0.2, 0.3);
    const Matches m = test::make_matches(pose, {8}, random);
    const std::vector<Vector2d>&reference = m.reference.undistorted, &current = m.current.undistorted;
    const Normalization nr{span<const Vector2d>(reference)}, nc{span<const Vector2d>(current)};
    std::array<Vector2d, 7> r, c;
    for (std::size_t i = 0; i < 7; ++i) {
      r[i] = nr(reference[i]);
      c[i] = nc(current[i]);
    }
    std::array<Matrix3d, 3> models;
    const std::size_t count = FundamentalSevenPoint::solve(r, c, models);
    double best = 1.0;
    for (std::size_t k = 0; k < count; ++k) {
      EXPECT_NEAR(models[k].determinant(), 0.0, 1e-9);
      for (std::size_t i = 0; i < 7; ++i)
        EXPECT_NEAR(c[i].homogeneous().dot(models[k] * r[i].homogeneous()), 0.0, 1e-9);
      best = std::min(best, difference(nc.matrix().transpose() * models[k] * nr.matrix(), true_fundamental(pose)));
    }
    EXPECT_LT(best, 1e-5);  // seven points may lie badly; 1e-16 times their condition

    Matrix3d f;
    ASSERT_TRUE(fundamental_eight_point(reference, current, f));
    EXPECT_LT(difference(f, true_fundamental(pose)), 1e-6);

    // OpenCV computes with single-precision points: hand both the same.
    Matches many = test::make_matches(pose, {40}, random);
    for (auto* side : {&many.reference.undistorted, &many.current.undistorted})
      for (Vector2d& p : *side) p = p.cast<float>().cast<double>();
    ASSERT_TRUE(fundamental_eight_point(many.reference.undistorted, many.current.undistorted, f));
    Matrix3d theirs;
    cv::cv2eigen(
        cv::findFundamentalMat(points(many.reference.undistorted), points(many.current.undistorted), cv::FM_8POINT),
        theirs);
    EXPECT_LT(difference(f, theirs), 1e-6);
  }
}

TEST(Fundamental, DegenerateInputHasNoSolution) {
  std::array<Matrix3d, 3> models;
  std::array<Vector2d, 7> seven;
  seven.fill({0.3, 0.4});
  EXPECT_EQ(FundamentalSevenPoint::solve(seven, seven, models), 0u);
  for (std::size_t i = 0; i < 7; ++i) seven[i] = {0.1 * static_cast<double>(i), 0.2};
  EXPECT_EQ(FundamentalSevenPoint::solve(seven, seven, models), 0u);
  seven[0].x() = std::numeric_limits<double>::quiet_NaN();
  EXPECT_EQ(FundamentalSevenPoint::solve(seven, seven, models), 0u);
  Matrix3d f;
  for (const std::size_t count : {0u, 1u, 2u, 7u}) {
    const std::vector<Vector2d> few(count, Vector2d(1, 2));
    EXPECT_FALSE(fundamental_eight_point(few, few, f));
  }
  Random random(1);
  for (const bool line : {false, true}) {
    test::SceneOptions scene;
    scene.plane = !line;
    scene.line = line;
    const Matches m = test::make_matches(test::random_motion(random, 0.1, 0.2), scene, random);
    EXPECT_FALSE(fundamental_eight_point(m.reference.undistorted, m.current.undistorted, f));
  }
}

TEST(FundamentalEstimator, ResidualIsTheDistanceOfEq2) {
  // A step along x: epipolar lines are rows, so that D is the difference in v. 3 px for the first match.
  Workspace workspace;
  Random random(2);
  Matches m = test::make_matches(test::pose_of(Vector3d::Zero(), {0.1, 0, 0}), {40}, random);
  m.current.undistorted[0].y() += 3.0;
  const FundamentalEstimator<FundamentalEightPoint> estimator(m.reference.undistorted, m.current.undistorted,
                                                              workspace);
  Matrix3d f = skew(Vector3d::UnitX());
  const Normalization nr{span<const Vector2d>(m.reference.undistorted)},
      nc{span<const Vector2d>(m.current.undistorted)};
  f = nc.matrix().inverse().transpose() * f * nr.matrix().inverse();
  EXPECT_NEAR(estimator.squared_residual(f, 0), 9.0, 1e-2);  // single precision
  for (std::size_t i = 1; i < 40; ++i) EXPECT_LT(estimator.squared_residual(f, i), 1e-6);
  EXPECT_LT(difference(estimator.in_pixels(f), skew(Vector3d::UnitX())), 1e-9);
}

TEST(Essential, DecompositionHoldsTheMotionAsOpenCvDoes) {
  const test::TestCamera camera = test::test_camera();
  for (std::uint64_t seed = 0; seed < 100; ++seed) {
    Random random(seed);
    const Pose truth = test::random_motion(random, 0.3, 1.0);
    const Matches m = test::make_matches(truth, {30}, random);
    const Matrix3d e = essential_from_fundamental(true_fundamental(truth), camera.matrix());
    EXPECT_LT(difference(e, skew(truth.translation()) * truth.linear()), 1e-9);
    EXPECT_GT(difference(essential_as_printed(true_fundamental(truth), camera.matrix()), e), 1e-3);
    std::vector<Vector3d> reference, current;
    for (std::size_t i = 0; i < m.size(); ++i) {
      reference.push_back(camera.back_project(m.reference.undistorted[i], 1.0));
      current.push_back(camera.back_project(m.current.undistorted[i], 1.0));
    }
    const CheiralPose found = choose_in_front(decompose_essential(e), reference, current);
    EXPECT_LT(test::rotation_error(found.current_from_reference, truth), 1e-9);
    EXPECT_LT(test::translation_error(found.current_from_reference, truth), 1e-9);

    cv::Mat e_cv, k_cv, r_cv, t_cv;
    cv::eigen2cv(e, e_cv);
    cv::eigen2cv(camera.matrix(), k_cv);
    cv::recoverPose(e_cv, points(m.reference.undistorted), points(m.current.undistorted), k_cv, r_cv, t_cv);
    Pose theirs = Pose::Identity();
    Matrix3d r;
    Vector3d t;
    cv::cv2eigen(r_cv, r);
    cv::cv2eigen(t_cv, t);
    theirs.linear() = r;
    theirs.translation() = t;
    EXPECT_LT(test::rotation_error(found.current_from_reference, theirs), 1e-9);
    EXPECT_LT(test::translation_error(found.current_from_reference, theirs), 1e-9);
  }
}

TEST(Triangulation, DepthsAreThoseOfAPointComputedByHand) {
  // The point (0, 0, 2) from the reference, and from a camera 1 m to its right: there it is (-1, 0, 2).
  const Pose pose = test::pose_of(Vector3d::Zero(), {-1, 0, 0});
  const RayDepths depths = triangulate(pose, {0, 0, 1}, {-0.5, 0, 1});
  EXPECT_NEAR(depths.reference, 2.0, 1e-12);
  EXPECT_NEAR(depths.current, 2.0, 1e-12);
  EXPECT_TRUE(depths.in_front());
  EXPECT_FALSE(triangulate(pose, {0, 0, 1}, {0.5, 0, 1}).in_front());
  EXPECT_FALSE(triangulate(pose, {0, 0, 1}, {0, 0, 1}).in_front());  // parallel
}

}  // namespace
}  // namespace stillpoint
