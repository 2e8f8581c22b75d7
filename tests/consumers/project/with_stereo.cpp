// SPDX-FileCopyrightText: 2026 The stillpoint authors
// SPDX-License-Identifier: MIT

// A host with two cameras, tried in a rendered room: its depth must be that of the room, and the score of a filter that
// keeps all must say that it dropped nothing.

#include <cmath>
#include <cstdio>
#include <opencv2/core.hpp>
#include <stillpoint/core/compact.hpp>
#include <stillpoint/evaluation/feature_score.hpp>
#include <stillpoint/evaluation/mover_score.hpp>
#include <stillpoint/evaluation/noise_calibration.hpp>
#include <stillpoint/null_filter.hpp>
#include <stillpoint/opencv.hpp>
#include <stillpoint/stereo/rectification.hpp>
#include <stillpoint/stereo/stereo_depth.hpp>
#include <stillpoint/synthetic/moving_day.hpp>
#include <stillpoint/synthetic/realistic_scenes.hpp>
#include <stillpoint/synthetic/renderer.hpp>
#include <stillpoint/synthetic/stereo.hpp>
#include <stillpoint/synthetic/street.hpp>
#include <vector>

int main() {
  constexpr double kBaseline_m = 0.11;
  stillpoint::synthetic::SceneOptions options;
  options.width = 320, options.height = 240;
  const stillpoint::synthetic::Scene scene = stillpoint::synthetic::walking_people(options);
  stillpoint::SyntheticSequence left_camera(scene), right_camera(stillpoint::synthetic::right_of(scene, kBaseline_m));
  stillpoint::Pose right_from_left = stillpoint::Pose::Identity();
  right_from_left.translation().x() = -kBaseline_m;
  const stillpoint::StereoRectification pair(scene.camera, scene.camera, right_from_left);
  stillpoint::StereoDepth stereo(pair.camera(), pair.baseline_m());

  stillpoint::NullFilter filter;
  stillpoint::FilterScore score;
  stillpoint::SyntheticFrame left, right;
  std::size_t kept = 0, pixels = 0, measured = 0, right_depths = 0;
  for (const int index : {0, 10}) {
    left_camera.render(index, left);
    right_camera.render(index, right);
    cv::Mat rectified_left, rectified_right, depth_m;
    pair.rectify(stillpoint::as_mat(left.gray.view()), stillpoint::as_mat(right.gray.view()), rectified_left,
                 rectified_right);
    stereo.compute(rectified_left, rectified_right, depth_m);

    std::vector<stillpoint::Vector2f> keypoints;
    const cv::Mat exact_m = stillpoint::as_mat(left.exact_depth.view());
    for (int v = 0; v < depth_m.rows; ++v)
      for (int u = 0; u < depth_m.cols; ++u) {
        const float found_m = depth_m.at<float>(v, u), true_m = exact_m.at<float>(v, u);
        ++pixels;
        measured += found_m > 0;
        right_depths += std::abs(found_m - true_m) < 0.1f * true_m;
        if (u % 8 == 0 && v % 8 == 0) keypoints.emplace_back(u, v);
      }
    const auto& result = filter.filter_frame({rectified_left, depth_m, left.timestamp_s}, keypoints);
    score.add_frame(left.labels.view(), keypoints, result.keep());
    kept = stillpoint::kept_count(result.keep());
  }
  std::printf("%zu of %zu pixels have a depth, %zu the right one; kept %zu of 1200, %zu of %zu that move dropped\n",
              measured, pixels, right_depths, kept, score.moving().dropped, score.moving().features);
  const bool sees = 2 * measured > pixels && 10 * right_depths > 9 * measured;
  return sees && kept == 1200 && score.moving().features > 0 && score.moving().dropped == 0 ? 0 : 1;
}
