// SPDX-FileCopyrightText: 2026 The stillpoint authors
// SPDX-License-Identifier: MIT

#include "stillpoint/cluster/k_means.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <opencv2/core.hpp>
#include <set>
#include <vector>

namespace stillpoint {
namespace {

using Eigen::Vector3f;
using Cloud = std::vector<Vector3d>;

/// A result that outlives the workspace it was computed in.
struct Clusters {
  std::vector<std::int32_t> cluster;
  std::vector<Vector3f> centre;
  std::vector<std::size_t> member_count;
  double cost = 0;
  int iterations = 0;
};

PointArrays arrays(const Cloud& cloud, Workspace& workspace) {
  PointArrays points(cloud.size(), workspace);
  for (std::size_t i = 0; i < cloud.size(); ++i) points.set(i, cloud[i]);
  return points;
}

Clusters cluster(const Cloud& cloud, std::vector<Vector3f> start, int max_iterations = 100) {
  Workspace workspace;
  const PointArrays points = arrays(cloud, workspace);
  const KMeansResult result = lloyd(points, span<Vector3f>(start), max_iterations, workspace);
  return {{result.cluster.begin(), result.cluster.end()},
          {result.centre.begin(), result.centre.end()},
          {result.member_count.begin(), result.member_count.end()},
          result.cost,
          result.iterations};
}

std::vector<Vector3f> seeds(const Cloud& cloud, std::size_t k, std::uint64_t seed) {
  Workspace workspace;
  Random random(seed);
  const span<Vector3f> centres = k_means_plus_plus(arrays(cloud, workspace), k, random, workspace);
  return {centres.begin(), centres.end()};
}

/// Eq. 11 by its definition.
double cost_of(const Cloud& cloud, const Clusters& clusters) {
  double cost = 0;
  for (std::size_t i = 0; i < cloud.size(); ++i)
    cost += (cloud[i] - clusters.centre[static_cast<std::size_t>(clusters.cluster[i])].cast<double>()).squaredNorm();
  return cost;
}

/// A few blobs of different widths, some points twice.
Cloud random_cloud(Random& random, std::size_t count) {
  std::vector<Vector3d> blobs(1 + random.index(6));
  for (Vector3d& blob : blobs) blob = {random.uniform(-2, 2), random.uniform(-1, 1), random.uniform(1, 5)};
  Cloud cloud;
  for (std::size_t i = 0; i < count; ++i) {
    if (i > 0 && random.index(10) == 0) {
      cloud.push_back(cloud[random.index(i)]);
      continue;
    }
    const std::size_t b = random.index(blobs.size());
    const double width = 0.05 + 0.1 * static_cast<double>(b);
    const Vector3d offset(random.gaussian(), random.gaussian(), random.gaussian());
    cloud.push_back((blobs[b] + width * offset).cast<float>().cast<double>());
  }
  return cloud;
}

constexpr double kFloat = 1e-5;  // coordinates and distances are floats: relative error of a sum of such

TEST(Lloyd, TwoPairsByHand) {
  // Start at 0 and 4: 0 and 1 go to the first, 10 and 12 to the second; means 0.5 and 11.
  // J = 0.5² + 0.5² + 1² + 1² = 2.5. The second iteration changes nothing.
  const Cloud cloud = {{0, 0, 0}, {1, 0, 0}, {10, 0, 0}, {12, 0, 0}};
  const Clusters result = cluster(cloud, {{0, 0, 0}, {4, 0, 0}});
  EXPECT_EQ(result.cluster, (std::vector<std::int32_t>{0, 0, 1, 1}));
  EXPECT_EQ(result.centre[0], Vector3f(0.5f, 0, 0));
  EXPECT_EQ(result.centre[1], Vector3f(11, 0, 0));
  EXPECT_EQ(result.member_count, (std::vector<std::size_t>{2, 2}));
  EXPECT_DOUBLE_EQ(result.cost, 2.5);
  EXPECT_EQ(result.iterations, 2);
}

TEST(Lloyd, AllThreeAxesCount) {
  const Cloud cloud = {{0, 0, 0}, {0, 0, 1}, {0, 5, 0}, {0, 5, 1}};
  const Clusters result = cluster(cloud, {{0, 1, 0}, {0, 4, 0}});
  EXPECT_EQ(result.cluster, (std::vector<std::int32_t>{0, 0, 1, 1}));
  EXPECT_EQ(result.centre[1], Vector3f(0, 5, 0.5f));
  EXPECT_DOUBLE_EQ(result.cost, 1.0);
}

TEST(Lloyd, OfTwoEqualCentresTheFirstTakesThePoint) {
  const Clusters result = cluster({{0, 0, 0}, {2, 0, 0}, {1, 0, 0}}, {{0, 0, 0}, {2, 0, 0}}, 1);
  EXPECT_EQ(result.cluster, (std::vector<std::int32_t>{0, 1, 0}));
}

TEST(Lloyd, AnEmptyClusterTakesTheFarthestPoint) {
  // Both centres far left, the second farther: all go to the first, whose farthest point is 9.
  const Clusters result = cluster({{0, 0, 0}, {1, 0, 0}, {9, 0, 0}}, {{-5, 0, 0}, {-50, 0, 0}});
  EXPECT_EQ(result.cluster, (std::vector<std::int32_t>{0, 0, 1}));
  EXPECT_EQ(result.centre[0], Vector3f(0.5f, 0, 0));
  EXPECT_EQ(result.centre[1], Vector3f(9, 0, 0));
  EXPECT_DOUBLE_EQ(result.cost, 0.5);
}

TEST(Lloyd, OneClusterIsTheMean) {
  const Cloud cloud = {{1, 2, 3}, {3, 2, 1}, {2, 8, 2}};
  const Clusters result = cluster(cloud, {{100, 100, 100}});
  EXPECT_EQ(result.centre[0], Vector3f(2, 4, 2));
  EXPECT_EQ(result.member_count[0], 3u);
  EXPECT_DOUBLE_EQ(result.cost, 2 * (1 + 4 + 1) + 16.0);
}

TEST(Lloyd, AsManyClustersAsPointsCostNothing) {
  for (std::uint64_t seed = 0; seed < 20; ++seed) {
    Cloud cloud;
    for (int i = 0; i < 9; ++i) cloud.emplace_back(i, i * i, -i);
    const Clusters result = cluster(cloud, seeds(cloud, 9, seed));
    EXPECT_EQ(result.cost, 0.0);
    EXPECT_EQ(std::set<std::int32_t>(result.cluster.begin(), result.cluster.end()).size(), 9u);
  }
}

TEST(Lloyd, FewerDifferentPointsThanClustersEndsAtOnce) {
  for (std::uint64_t seed = 0; seed < 20; ++seed) {
    Cloud cloud(20, Vector3d(1, 2, 3));
    for (std::size_t i = 0; i < 7; ++i) cloud[i] = {4, 5, 6};
    const Clusters result = cluster(cloud, seeds(cloud, 5, seed));
    EXPECT_EQ(result.cost, 0.0);
    for (const std::size_t members : result.member_count) EXPECT_GE(members, 1u);
    EXPECT_LE(result.iterations, 2) << "there is nothing to improve";
  }
}

TEST(Lloyd, AssignsEveryPointEvenWithoutIterations) {
  const Cloud cloud = {{0, 0, 0}, {1, 0, 0}, {10, 0, 0}};
  for (const int none : {0, -1}) {
    const Clusters result = cluster(cloud, {{0, 0, 0}, {9, 0, 0}}, none);
    EXPECT_EQ(result.cluster, (std::vector<std::int32_t>{0, 0, 1}));
    EXPECT_EQ(result.iterations, 1);
  }
}

TEST(Lloyd, HoldsItsPropertiesOnRandomClouds) {
  for (std::uint64_t seed = 0; seed < 150; ++seed) {
    Random random(seed);
    const std::size_t count = 1 + random.index(200);
    const Cloud cloud = random_cloud(random, count);
    const std::size_t k = 1 + random.index(std::min<std::size_t>(count, 20));
    const std::vector<Vector3f> start = seeds(cloud, k, seed);
    SCOPED_TRACE(testing::Message() << "seed " << seed << ", " << count << " points, k " << k);

    const Clusters result = cluster(cloud, start, 1000);
    ASSERT_LT(result.iterations, 1000) << "it must come to an end";
    EXPECT_NEAR(result.cost, cost_of(cloud, result), kFloat * result.cost + 1e-12);

    std::vector<std::size_t> members(k, 0);
    for (std::size_t i = 0; i < count; ++i) {
      ASSERT_GE(result.cluster[i], 0);
      ASSERT_LT(static_cast<std::size_t>(result.cluster[i]), k);
      ++members[static_cast<std::size_t>(result.cluster[i])];
      double nearest = 1e30;
      for (const Vector3f& centre : result.centre)
        nearest = std::min(nearest, (cloud[i] - centre.cast<double>()).squaredNorm());
      const Vector3f& own = result.centre[static_cast<std::size_t>(result.cluster[i])];
      ASSERT_LE((cloud[i] - own.cast<double>()).squaredNorm(), nearest + 1e-5) << "point " << i;
    }
    EXPECT_EQ(members, result.member_count);
    for (const std::size_t count_of_cluster : members) EXPECT_GE(count_of_cluster, 1u);

    for (std::size_t c = 0; c < k; ++c) {
      Vector3d mean = Vector3d::Zero();
      for (std::size_t i = 0; i < count; ++i)
        if (result.cluster[i] == static_cast<std::int32_t>(c)) mean += cloud[i] / static_cast<double>(members[c]);
      EXPECT_LE((mean - result.centre[c].cast<double>()).norm(), 1e-5) << "centre " << c;
    }

    double before = 1e30;
    for (int iterations = 1; iterations <= 8; ++iterations) {
      const Clusters stopped = cluster(cloud, start, iterations);
      EXPECT_NEAR(stopped.cost, cost_of(cloud, stopped), kFloat * stopped.cost + 1e-12) << "stopped early";
      EXPECT_LE(stopped.cost, before * (1 + kFloat)) << iterations << " iterations";
      before = stopped.cost;
    }
  }
}

TEST(Lloyd, EqualsOpenCVFromTheSameStart) {
  for (std::uint64_t seed = 0; seed < 100; ++seed) {
    Random random(1000 + seed);
    const std::size_t count = 60 + random.index(500), k = 2 + random.index(12);
    const Cloud cloud = random_cloud(random, count);
    const std::vector<Vector3f> start = seeds(cloud, k, seed);
    cv::Mat samples(static_cast<int>(count), 3, CV_32FC1), centres;
    for (std::size_t i = 0; i < count; ++i)
      for (int axis = 0; axis < 3; ++axis)
        samples.at<float>(static_cast<int>(i), axis) = static_cast<float>(cloud[i][axis]);
    // OpenCV starts from labels: those that our first iteration gives. Its first iteration makes centres of them.
    const cv::Mat first_labels(cluster(cloud, start, 1).cluster, true);
    for (const int iterations : {2, 3, 5, 100}) {
      cv::Mat labels = first_labels.clone();
      const cv::TermCriteria stop(cv::TermCriteria::COUNT + cv::TermCriteria::EPS, iterations, 0.0);
      const double expected =
          cv::kmeans(samples, static_cast<int>(k), labels, stop, 1, cv::KMEANS_USE_INITIAL_LABELS, centres);
      const Clusters ours = cluster(cloud, start, iterations);
      ASSERT_NEAR(ours.cost, expected, 1e-4 * expected) << "seed " << seed << ", k " << k << ", " << iterations;
    }
  }
}

TEST(KMeansPlusPlus, ChoosesPointsOfTheCloudAndNoneTwice) {
  for (std::uint64_t seed = 0; seed < 100; ++seed) {
    Random random(seed);
    Cloud cloud;
    for (int i = 0; i < 40; ++i) cloud.emplace_back(i % 20, 0, 0);  // every point twice
    std::set<float> chosen;
    for (const Vector3f& centre : seeds(cloud, 20, seed)) {
      EXPECT_TRUE(centre.y() == 0 && centre.z() == 0 && centre.x() == std::floor(centre.x()));
      chosen.insert(centre.x());
    }
    EXPECT_EQ(chosen.size(), 20u) << "a point at a centre has no probability";
  }
}

// From the point 0 the others at 1 and 3 have the squared distances 1 and 9: the second centre is at 3 in 9 of 10
// draws. From 1: 1 and 4; from 3: 9 and 4. Each is first in a third.
TEST(KMeansPlusPlus, DrawsByTheSquaredDistance) {
  const Cloud cloud = {{0, 0, 0}, {1, 0, 0}, {3, 0, 0}};
  Workspace workspace;
  const PointArrays points = arrays(cloud, workspace);
  Random random(5);
  double count[4][4] = {};
  constexpr int draws = 30000;
  for (int i = 0; i < draws; ++i) {
    const Workspace::Scope scope(workspace);
    const span<Vector3f> centres = k_means_plus_plus(points, 2, random, workspace);
    ++count[static_cast<int>(centres[0].x())][static_cast<int>(centres[1].x())];
  }
  const auto expect_share = [&](int first, int second, double share) {
    const double p = share / 3.0;
    EXPECT_NEAR(count[first][second] / draws, p, 5 * std::sqrt(p * (1 - p) / draws)) << first << ", " << second;
  };
  expect_share(0, 1, 0.1);
  expect_share(0, 3, 0.9);
  expect_share(1, 0, 0.2);
  expect_share(1, 3, 0.8);
  expect_share(3, 0, 9.0 / 13.0);
  expect_share(3, 1, 4.0 / 13.0);
}

TEST(KMeansPlusPlus, EqualSeedsGiveEqualResults) {
  Random random(9);
  const Cloud cloud = random_cloud(random, 300);
  const Clusters a = cluster(cloud, seeds(cloud, 10, 42)), b = cluster(cloud, seeds(cloud, 10, 42));
  EXPECT_EQ(a.cluster, b.cluster);
  EXPECT_EQ(a.centre, b.centre);
  EXPECT_EQ(a.cost, b.cost);
  EXPECT_NE(seeds(cloud, 10, 42), seeds(cloud, 10, 43));
}

TEST(PointArrays, ThePaddingIsInNoCluster) {
  // 17 points: 15 zeros of padding, nearer to the first centre than any point is.
  Cloud cloud(17, Vector3d(10, 10, 10));
  cloud[16] = {20, 20, 20};
  const Clusters result = cluster(cloud, {{0, 0, 0}, {20, 20, 20}});
  EXPECT_EQ(result.member_count, (std::vector<std::size_t>{16, 1}));
  EXPECT_EQ(result.centre[0], Vector3f(10, 10, 10));
  EXPECT_EQ(result.cost, 0.0);
}

}  // namespace
}  // namespace stillpoint
