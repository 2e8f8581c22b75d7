// SPDX-FileCopyrightText: 2026 The stillpoint authors
// SPDX-License-Identifier: MIT

// reference FOLDER [RECORDED]: writes a rendered sequence in the layout of the TUM benchmark, and what the C++ says of
// it, bit for bit: features_<i>.bin, masks_<i>.bin, poses_<i>.bin, movers_<i>.bin and figures.txt; the .bin with
// movers in FOLDER/movers. RECORDED is a folder of that layout: recorded_<i>.bin are the features of its first frames.
// tests/python/test_equal_to_cpp.py calls the same in Python.

#include <cstdint>
#include <cstdio>
#include <exception>
#include <filesystem>
#include <fstream>
#include <opencv2/features2d.hpp>
#include <opencv2/imgcodecs.hpp>
#include <opencv2/imgproc.hpp>
#include <string>
#include <utility>
#include <vector>

#include "stillpoint/evaluation/feature_score.hpp"
#include "stillpoint/evaluation/trajectory_error.hpp"
#include "stillpoint/io/number_format.hpp"
#include "stillpoint/io/trajectory_file.hpp"
#include "stillpoint/io/tum_sequence.hpp"
#include "stillpoint/policies/with_movers.hpp"
#include "stillpoint/prior/propagated_prior.hpp"
#include "stillpoint/stillpoint.hpp"
#include "stillpoint/synthetic/renderer.hpp"
#include "stillpoint/synthetic/scenes.hpp"

namespace {

namespace fs = std::filesystem;
using stillpoint::FrameResult, stillpoint::ImageBuffer, stillpoint::Pose;
using RowMajor = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;

/// What test_equal_to_cpp.py does at the same frames.
constexpr int kFrames = 14, kExpectedAt = 5, kDetectedAt = 9, kOptionAt = 8, kResetAt = 11, kRecordedFrames = 30;

/// One keypoint, without gaps, as numpy reads it.
struct Feature {
  double depth_m;
  float x, y, score, probability, weight;
  std::int32_t cluster;
  std::uint8_t keep, verdict, reason, padding[5];
};
static_assert(sizeof(Feature) == 40);

class Bytes {
 public:
  explicit Bytes(const fs::path& file) : stream_(file, std::ios::binary) {
    stream_.exceptions(std::ios::badbit | std::ios::failbit);
  }
  template <class T>
  void write(const T* values, std::size_t count) {
    stream_.write(reinterpret_cast<const char*>(values), static_cast<std::streamsize>(count * sizeof(T)));
  }

 private:
  std::ofstream stream_;
};

void write_features(const fs::path& file, const std::vector<cv::KeyPoint>& keypoints, const FrameResult& result) {
  std::vector<float> weights;
  stillpoint::weights(result, weights);
  Bytes bytes(file);
  for (std::size_t i = 0; i < keypoints.size(); ++i) {
    const stillpoint::Label& label = result.label(i);
    const Feature feature{result.depth_m(i),
                          keypoints[i].pt.x,
                          keypoints[i].pt.y,
                          result.score(i).value,
                          label.probability,
                          weights[i],
                          label.cluster,
                          result.keep()[i],
                          static_cast<std::uint8_t>(label.verdict),
                          static_cast<std::uint8_t>(label.reason),
                          {}};
    bytes.write(&feature, 1);
  }
}

void write_masks(const fs::path& file, const ImageBuffer& predicted, const FrameResult& result) {
  ImageBuffer mask;
  result.mask(mask);
  Bytes bytes(file);
  for (const ImageBuffer* const buffer : {&predicted, static_cast<const ImageBuffer*>(&mask)}) {
    const stillpoint::ImageView view = buffer->view();
    bytes.write(view.data, static_cast<std::size_t>(view.width) * static_cast<std::size_t>(view.height));
  }
}

/// world_from_camera, the true motion since the last frame, and the filter's, row by row; the status.
void write_poses(const fs::path& file, const Pose& truth, const Pose& true_motion, const FrameResult& result) {
  const RowMajor matrices[3] = {truth.matrix(), true_motion.matrix(), result.motion().current_from_reference.matrix()};
  const double status = static_cast<double>(result.status());
  Bytes bytes(file);
  for (const RowMajor& matrix : matrices) bytes.write(matrix.data(), 16);
  bytes.write(&status, 1);
}

/// Of each mover all numbers, one after the other; then the index of each keypoint's; then their masks.
void write_movers(const fs::path& file, const FrameResult& result) {
  Bytes bytes(file);
  const auto number = [&](auto value) {
    const auto written = static_cast<double>(value);
    bytes.write(&written, 1);
  };
  const auto matrix = [&](const RowMajor& values) {
    bytes.write(values.data(), static_cast<std::size_t>(values.size()));
  };
  number(result.movers().size());
  for (const stillpoint::Mover& mover : result.movers()) {
    number(mover.id);
    number(mover.state);
    for (const float value : {mover.box.x, mover.box.y, mover.box.width, mover.box.height}) number(value);
    for (const stillpoint::Vector3d& vector : {mover.centroid, mover.extent_m, mover.velocity}) matrix(vector);
    matrix(mover.velocity_covariance);
    matrix(mover.current_from_reference.matrix());
    matrix(mover.covariance);
    number(mover.has_rotation);
    number(mover.class_index);
    for (const double value : {static_cast<double>(mover.confidence), mover.first_seen_s, mover.last_seen_s})
      number(value);
  }
  for (std::size_t i = 0; i < result.size(); ++i)
    number(result.mover(i) == nullptr ? -1 : result.mover(i) - result.movers().data());
  ImageBuffer mask;
  for (const stillpoint::Mover& mover : result.movers()) {
    result.mask(mover, mask);
    const stillpoint::ImageView view = mask.view();
    bytes.write(view.data, static_cast<std::size_t>(view.width) * static_cast<std::size_t>(view.height));
  }
}

void write_image(const fs::path& file, const ImageBuffer& image) {
  if (!cv::imwrite(file.string(), stillpoint::as_mat(image.view())))
    throw stillpoint::Error(file.string() + ": cannot write");
}

void write_figures(const fs::path& folder, const stillpoint::FilterScore& score) {
  const stillpoint::Trajectory truth = stillpoint::read_trajectory(folder / "groundtruth.txt");
  const stillpoint::Trajectory estimate = stillpoint::read_trajectory(folder / "estimate.txt");
  const auto ate = stillpoint::absolute_trajectory_error(truth, estimate, stillpoint::Alignment::se3);
  const auto rpe = stillpoint::relative_trajectory_error(truth, estimate);
  std::ofstream figures(folder / "figures.txt");
  const auto write = [&](const char* name, double value) {
    figures << name << ' ' << stillpoint::option_text(value) << '\n';
  };
  write("ate_rmse_m", stillpoint::error_statistics(ate.errors.translation_m).rmse);
  write("ate_rotation_median_deg", stillpoint::error_statistics(ate.errors.rotation_deg).median);
  write("rpe_rmse_m", stillpoint::error_statistics(rpe.translation_m).rmse);
  write("recall", score.recall().value());
  write("false_positive_rate", score.false_positive_rate().value());
}

std::string numbered(const char* name, int i) {
  char text[32];
  std::snprintf(text, sizeof text, "%s_%02d.bin", name, i);
  return text;
}

void run_recorded(const fs::path& recorded, const fs::path& folder) {
  const stillpoint::TumSequence sequence(recorded);
  stillpoint::FrameFilter<stillpoint::WithMovers<>> filter(sequence.camera());
  filter.movers.is_enabled = false;
  const auto orb = cv::ORB::create(1000);
  for (int i = 0; i < kRecordedFrames; ++i) {
    const auto index = static_cast<std::size_t>(i);
    const stillpoint::RgbdImages images = sequence.load(index);
    cv::Mat gray;
    cv::cvtColor(images.colour, gray, cv::COLOR_BGR2GRAY);
    std::vector<cv::KeyPoint> keypoints;
    orb->detect(gray, keypoints);
    const stillpoint::DepthView depth(images.depth, sequence.depth_factor());
    write_features(folder / numbered("recorded", i), keypoints,
                   filter.filter_frame({gray, depth, sequence.frames()[index].timestamp_s}, keypoints));
  }
}

/// A filter, with movers or without, and where its answers go.
struct Side {
  Side(const stillpoint::Camera& camera, fs::path out, bool has_movers) : folder(std::move(out)), filter(camera) {
    fs::create_directories(folder);
    filter.movers.is_enabled = has_movers;
    filter.movers.options.least_path_m = 0.003;  // of these few frames
    filter.movers.options.least_path_sigmas = 1;
  }

  const FrameResult& answer(int i, const stillpoint::SyntheticFrame& frame, const std::vector<cv::KeyPoint>& keypoints,
                            const Pose& true_motion) {
    if (i == kOptionAt) filter.gate.options.false_positive_rate = 0.02;
    if (i == kResetAt) filter.reset();
    if (i == kExpectedAt) filter.expect_motion(true_motion);
    if (i == kDetectedAt) {
      stillpoint::Detection person{{0, 40, 100, 150}, stillpoint::Mobility::dynamic, 0.9f};
      person.class_index = 7;
      filter.prior.detected(frame.timestamp_s, {person});
    }
    filter.predicted_keep_mask(frame.timestamp_s, 8, predicted);
    const FrameResult& result = filter.filter_frame(
        {frame.gray.view(), stillpoint::DepthView(frame.depth.view(), frame.depth_factor), frame.timestamp_s},
        keypoints);
    filter.feedback(frame.world_from_camera);
    write_features(folder / numbered("features", i), keypoints, result);
    write_masks(folder / numbered("masks", i), predicted, result);
    write_poses(folder / numbered("poses", i), frame.world_from_camera, true_motion, result);
    write_movers(folder / numbered("movers", i), result);
    return result;
  }

  fs::path folder;
  stillpoint::FrameFilter<stillpoint::WithMovers<>> filter;
  ImageBuffer predicted;
};

void run(const fs::path& folder) {
  stillpoint::synthetic::SceneOptions options;
  options.width = 320;
  options.height = 240;
  options.frames = kFrames;
  stillpoint::SyntheticSequence sequence(stillpoint::synthetic::walking_people(options));
  const stillpoint::Camera& camera = sequence.camera();
  for (const char* const name : {"rgb", "depth", "labels"}) fs::create_directories(folder / name);
  std::ofstream associations(folder / "associations.txt"), camera_yaml(folder / "camera.yaml");
  std::ofstream colour_list(folder / "rgb.txt"), depth_list(folder / "depth.txt");
  const auto text = [](double value) { return stillpoint::option_text(value); };
  camera_yaml << "fx: " << text(camera.fx()) << "\nfy: " << text(camera.fy()) << "\ncx: " << text(camera.cx())
              << "\ncy: " << text(camera.cy()) << "\nwidth: " << camera.width() << "\nheight: " << camera.height()
              << "\ndepth_factor: " << text(sequence.scene().sensor.depth_factor) << '\n';

  Side without(camera, folder, false), with_movers(camera, folder / "movers", true);
  stillpoint::SyntheticFrame frame;
  stillpoint::FilterScore score;
  stillpoint::Trajectory truth, estimate;
  Pose last = Pose::Identity(), world_from_camera = Pose::Identity();
  const auto orb = cv::ORB::create(400);
  for (int i = 0; i < kFrames; ++i) {
    sequence.render(i, frame);
    char name[16];
    std::snprintf(name, sizeof name, "%02d", i);
    write_image(folder / "rgb" / (std::string(name) + ".png"), frame.gray);
    write_image(folder / "depth" / (std::string(name) + ".png"), frame.depth);
    write_image(folder / "labels" / (std::string(name) + ".png"), frame.labels);
    const std::string time = stillpoint::format_timestamp(frame.timestamp_s);
    associations << time << " rgb/" << name << ".png " << time << " depth/" << name << ".png\n";
    colour_list << time << " rgb/" << name << ".png\n";
    depth_list << time << " depth/" << name << ".png\n";
    std::vector<cv::KeyPoint> keypoints;
    orb->detect(stillpoint::as_mat(frame.gray.view()), keypoints);

    const Pose true_motion = frame.world_from_camera.inverse() * last;
    with_movers.answer(i, frame, keypoints, true_motion);
    const FrameResult& result = without.answer(i, frame, keypoints, true_motion);
    std::vector<stillpoint::Vector2f> pixels;
    stillpoint::read_pixels(keypoints, pixels);
    score.add_frame(frame.labels.view(), pixels, result.keep());
    if (result.motion().usable())
      world_from_camera = world_from_camera * result.motion().current_from_reference.inverse();
    truth.push_back({frame.timestamp_s, frame.world_from_camera});
    estimate.push_back({frame.timestamp_s, world_from_camera});
    last = frame.world_from_camera;
  }
  stillpoint::write_trajectory(folder / "groundtruth.txt", truth);
  stillpoint::write_trajectory(folder / "estimate.txt", estimate);
  write_figures(folder, score);
}

}  // namespace

int main(int argument_count, char** arguments) {
  try {
    if (argument_count != 2 && argument_count != 3) throw stillpoint::Error("usage: reference FOLDER [RECORDED]");
    run(arguments[1]);
    if (argument_count == 3) run_recorded(arguments[2], arguments[1]);
  } catch (const std::exception& error) {
    std::fprintf(stderr, "reference: %s\n", error.what());
    return 1;
  }
}
