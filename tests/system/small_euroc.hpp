// SPDX-FileCopyrightText: 2026 The stillpoint authors
// SPDX-License-Identifier: MIT
#pragma once

// A synthetic scene as a folder in the layout of the EuRoC datasets: two cameras that are not rectified, on a body.

#include <opencv2/imgcodecs.hpp>

#include <array>
#include <cmath>
#include <filesystem>
#include <string>
#include <variant>

#include "run_program.hpp"
#include "stillpoint/core/camera.hpp"
#include "stillpoint/core/geometry.hpp"
#include "stillpoint/io/number_format.hpp"
#include "stillpoint/opencv.hpp"
#include "stillpoint/synthetic/renderer.hpp"
#include "stillpoint/synthetic/scenes.hpp"
#include "stillpoint/synthetic/stereo.hpp"

namespace system_test {

/// Two cameras with lenses like EuRoC's, but half as strong: each is 11 cm from the other and turned by a degree.
struct StereoRig {
  stillpoint::Camera left, right;
  stillpoint::Pose left_from_right = stillpoint::Pose::Identity(), body_from_left = stillpoint::Pose::Identity();

  explicit StereoRig(const stillpoint::Camera& camera)
      : left(camera.fx(), camera.fy(), camera.cx(), camera.cy(), camera.width(), camera.height(),
             {stillpoint::BrownConrady{-0.14, 0.035, 0.0002, 0.00002, 0.0}}),
        right(1.004 * camera.fx(), 1.003 * camera.fy(), camera.cx() + 3, camera.cy() - 2, camera.width(),
              camera.height(), {stillpoint::BrownConrady{-0.14, 0.036, -0.0001, -0.00004, 0.0}}) {
    left_from_right.linear() = stillpoint::rotation_from_vector({0.008, -0.012, 0.006});
    left_from_right.translation() = stillpoint::Vector3d(0.11, 0.0012, -0.002);
    // The camera looks along the body's x axis, as on a drone.
    body_from_left.linear() << 0, 0, 1, -1, 0, 0, 0, -1, 0;
    body_from_left.translation() = stillpoint::Vector3d(0.02, -0.06, 0.01);
  }
};

inline std::string sensor_yaml(const stillpoint::Camera& camera, const stillpoint::Pose& body_from_camera) {
  const auto list = [](const auto& numbers) {
    std::string text;
    for (const double number : numbers) text += (text.empty() ? "[" : ", ") + stillpoint::format_fixed(number, 9);
    return text + "]\n";
  };
  std::array<double, 16> matrix;
  Eigen::Map<Eigen::Matrix<double, 4, 4, Eigen::RowMajor>>(matrix.data()) = body_from_camera.matrix();
  const auto& lens = std::get<stillpoint::BrownConrady>(camera.distortion().model);
  return "# General sensor definitions.\nsensor_type: camera\ncomment: rendered (two of them)\n\nT_BS:\n  cols: 4\n"
         "  rows: 4\n  data: " +
         list(matrix) + "\nrate_hz: 30\nresolution: [" + std::to_string(camera.width()) + ", " +
         std::to_string(camera.height()) + "]\ncamera_model: pinhole\nintrinsics: " +
         list(std::array<double, 4>{camera.fx(), camera.fy(), camera.cx(), camera.cy()}) +
         "distortion_model: radial-tangential\ndistortion_coefficients: " +
         list(std::array<double, 4>{lens.k1, lens.k2, lens.p1, lens.p2});
}

/// Renders all frames of a scene into mav0/, gray; with the ground truth of the body.
inline void write_euroc_sequence(const fs::path& folder, stillpoint::synthetic::Scene scene) {
  const StereoRig rig(scene.camera);
  scene.camera = rig.left;
  stillpoint::synthetic::Scene right_scene = stillpoint::synthetic::seen_from(scene, rig.left_from_right);
  right_scene.camera = rig.right;
  stillpoint::SyntheticSequence left(scene), right(right_scene);
  const fs::path mav0 = folder / "mav0";
  for (const char* name : {"cam0", "cam1"}) fs::create_directories(mav0 / name / "data");
  std::string images = "#timestamp [ns],filename\r\n";
  std::string truth =
      "#timestamp, p_RS_R_x [m], p_RS_R_y [m], p_RS_R_z [m], q_RS_w [], q_RS_x [], q_RS_y [], q_RS_z []\r\n";
  stillpoint::SyntheticFrame frame;
  for (int i = 0; i < left.size(); ++i) {
    left.render(i, frame);
    const std::string time_ns = std::to_string(1403636579763555584 + std::llround(1e9 * left.time_of(i)));
    cv::imwrite((mav0 / "cam0" / "data" / (time_ns + ".png")).string(), stillpoint::as_mat(frame.gray.view()));
    images += time_ns + ',' + time_ns + ".png\r\n";
    const stillpoint::Pose world_from_body = frame.world_from_camera * rig.body_from_left.inverse();
    const Eigen::Quaterniond q(world_from_body.linear());
    truth += time_ns;
    for (const double value : {world_from_body.translation().x(), world_from_body.translation().y(),
                               world_from_body.translation().z(), q.w(), q.x(), q.y(), q.z()})
      truth += ',' + stillpoint::format_fixed(value, 9);
    truth += ",0,0,0\r\n";
    right.render(i, frame);
    cv::imwrite((mav0 / "cam1" / "data" / (time_ns + ".png")).string(), stillpoint::as_mat(frame.gray.view()));
  }
  for (const char* name : {"cam0", "cam1"}) write_text(mav0 / name / "data.csv", images);
  write_text(mav0 / "cam0" / "sensor.yaml", sensor_yaml(rig.left, rig.body_from_left));
  write_text(mav0 / "cam1" / "sensor.yaml", sensor_yaml(rig.right, rig.body_from_left * rig.left_from_right));
  write_text(mav0 / "state_groundtruth_estimate0" / "data.csv", truth);
}

/// Writes the first frames of the synthetic demo, 160 × 120 pixels.
inline void write_small_euroc_sequence(const fs::path& folder, int frame_count = 4) {
  stillpoint::synthetic::SceneOptions options;
  options.frames = frame_count;
  options.width = 160;
  options.height = 120;
  write_euroc_sequence(folder, stillpoint::synthetic::demo(options));
}

}  // namespace system_test
