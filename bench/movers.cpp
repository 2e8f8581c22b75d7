// SPDX-FileCopyrightText: 2026 The stillpoint authors
// SPDX-License-Identifier: MIT

// stillpoint_movers [NAME...]: movers against the true poses of objects, recorded and synthetic; one table in Markdown
// on standard output. NAME+boxes hands a detector's boxes over, too. movers.sh builds and runs it.

#include <opencv2/core/utility.hpp>

#include <cmath>
#include <cstdint>
#include <cstdio>
#include <exception>
#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "accuracy_sequence.hpp"
#include "quantiles.hpp"
#include "stillpoint/evaluation/error_statistics.hpp"
#include "stillpoint/evaluation/mover_score.hpp"
#include "stillpoint/filter_frame.hpp"
#include "stillpoint/io/table_reader.hpp"
#include "stillpoint/io/trajectory_file.hpp"
#include "stillpoint/policies/with_movers.hpp"
#include "stillpoint/synthetic/realistic_scenes.hpp"

namespace stillpoint::bench {
namespace {

/// A frame, its objects and which of them each feature lies on.
struct MoverFrame : LabelledFrame {
  std::vector<TrueObject> objects;
  std::vector<std::int32_t> object_of;
};
struct MoverSequence {
  Camera camera;
  std::vector<MoverFrame> frames;
  std::size_t object_count = 0;
};

int label_at(const cv::Mat& labels, const cv::KeyPoint& keypoint) {
  const int u = cvRound(keypoint.pt.x), v = cvRound(keypoint.pt.y);
  const bool inside = u >= 0 && v >= 0 && u < labels.cols && v < labels.rows;
  return inside ? labels.at<std::uint8_t>(v, u) : 0;
}

void count_moving(MoverFrame& frame) {
  for (std::size_t i = 0; i < frame.keypoints.size(); ++i)
    if (frame.object_of[i] >= 0 && label_at(frame.labels, frame.keypoints[i]) == 255)
      ++frame.objects[static_cast<std::size_t>(frame.object_of[i])].moving_features;
}

MoverSequence rendered(const synthetic::Scene& scene) {
  SyntheticSequence source(scene);
  MoverSequence sequence{source.camera(), {}, scene.movers.size()};
  const cv::Ptr<cv::ORB> orb = cv::ORB::create(kFeatures);
  SyntheticFrame image;
  for (int f = 0; f < source.size(); ++f) {
    source.render(f, image);
    MoverFrame frame;
    static_cast<LabelledFrame&>(frame) = labelled_frame(image, *orb);
    for (const Pose& pose : image.world_from_mover) frame.objects.push_back({pose, 0});
    const cv::Mat ids = as_mat(image.mover_ids.view());
    for (const cv::KeyPoint& keypoint : frame.keypoints) frame.object_of.push_back(label_at(ids, keypoint) - 1);
    count_moving(frame);
    sequence.frames.push_back(std::move(frame));
  }
  return sequence;
}

/// Poses of the objects by time, in milliseconds, and number; none where the folder has no such file: nothing moves.
/// @throws Error where a row is not `timestamp object_id tx ty tz qx qy qz qw`
std::map<std::pair<long, int>, Pose> object_poses(const std::filesystem::path& file) {
  std::map<std::pair<long, int>, Pose> poses;
  if (!std::filesystem::exists(file)) return poses;
  TableReader rows(file);
  while (rows.next_row()) {
    rows.require_columns(9, "timestamp object_id tx ty tz qx qy qz qw");
    const long time_ms = std::lround(rows.number(0, "timestamp") * 1000);
    poses[{time_ms, static_cast<int>(rows.number(1, "object_id"))}] = pose_in_row(rows, 2);
  }
  return poses;
}

/// Labels do not tell objects apart: a feature is of the object whose upright axis is nearest.
MoverSequence recorded(const std::filesystem::path& folder) {
  LabelledSequence source = recorded_sequence(folder, kAllFrames);
  const auto poses = object_poses(folder / "object_poses.txt");
  int object_count = 0;
  for (const auto& [key, pose] : poses) object_count = std::max(object_count, key.second + 1);
  MoverSequence sequence{source.camera, {}, static_cast<std::size_t>(object_count)};
  for (LabelledFrame& labelled : source.frames) {
    MoverFrame frame;
    static_cast<LabelledFrame&>(frame) = std::move(labelled);
    for (int o = 0; o < object_count; ++o) {
      const auto found = poses.find({std::lround(frame.timestamp_s * 1000), o});
      frame.objects.push_back({found == poses.end() ? Pose::Identity() : found->second, 0});
    }
    for (const cv::KeyPoint& keypoint : frame.keypoints) {
      frame.object_of.push_back(-1);
      const int label = label_at(frame.labels, keypoint);
      if (label != 255 && label != 128) continue;
      const double depth_m =
          frame.depth.at<std::uint16_t>(cvRound(keypoint.pt.y), cvRound(keypoint.pt.x)) / frame.depth_factor;
      if (!(depth_m > 0) || !frame.world_from_camera) continue;
      const Vector3d point =
          *frame.world_from_camera * sequence.camera.back_project(Vector2d(keypoint.pt.x, keypoint.pt.y), depth_m);
      double nearest_m = 0.8;
      for (int o = 0; o < object_count; ++o) {
        const Vector3d local = inverted(frame.objects[static_cast<std::size_t>(o)].world_from_object) * point;
        const double apart_m = std::hypot(local.x(), local.z());
        if (apart_m < nearest_m) nearest_m = apart_m, frame.object_of.back() = o;
      }
    }
    count_moving(frame);
    sequence.frames.push_back(std::move(frame));
  }
  return sequence;
}

/// @throws Error where it is neither the name of a scene nor of a recording
MoverSequence sequence_of(const std::string& name) {
  if (name == "walking_people") return rendered(synthetic::walking_people());
  if (name == "crossing_people") return rendered(synthetic::crossing_people());
  if (name == "person_behind_pillar") return rendered(synthetic::person_behind_pillar());
  if (name == "pushed_box") return rendered(synthetic::pushed_box());
  if (name == "static_room") return rendered(synthetic::static_room());
  if (name == "five_people") return rendered(synthetic::five_people());
  return recorded(std::filesystem::path(STILLPOINT_SHARED_DATA) / name);
}

/// @param gives_boxes  of a detector; where the scene is synthetic, the true ones
void measure(const std::string& name, const MoverSequence& sequence, bool gives_boxes) {
  FrameFilter<WithMovers<>> filter(sequence.camera);
  MoverScore score(sequence.object_count);
  double total_ms = 0, movers_ms = 0;
  for (const MoverFrame& frame : sequence.frames) {
    if (gives_boxes) filter.prior.detections = frame.detections;
    const FrameResult& result = filter.filter_frame(frame.view(), frame.keypoints);
    total_ms += result.timings().total_ms();
    movers_ms += result.timings()[Stage::movers];
    score.add_frame(frame.timestamp_s, frame.world_from_camera.value_or(Pose::Identity()), frame.objects,
                    frame.object_of, result);
  }
  const double share = 100.0 * movers_ms / total_ms;
  if (sequence.object_count == 0) {
    std::printf("| %s | | %zu | | | | | | | | | %.1f | %.1f |\n", name.c_str(), score.frames(),
                100.0 * static_cast<double>(score.frames_with_movers()) / static_cast<double>(score.frames()), share);
    return;
  }
  for (std::size_t o = 0; o < sequence.object_count; ++o) {
    const MoverFigures figures = score.figures(o);
    std::printf("| %s | %zu | %zu | %.1f | %zu | %.1f | %.2f | %.3f | %.3f | %.2f | %.3f | %.1f | %.1f |\n",
                name.c_str(), o, figures.frames, 100.0 * figures.found_share().value_or(0.0), figures.switches,
                100.0 * median(figures.carried_m), median(figures.carried_deg), median(figures.speed_m_s),
                median(figures.velocity_m_s), 1000.0 * error_statistics(figures.step_m).rmse,
                error_statistics(figures.step_deg).rmse,
                100.0 * static_cast<double>(score.frames_with_movers()) / static_cast<double>(score.frames()), share);
  }
  std::fflush(stdout);
}

}  // namespace
}  // namespace stillpoint::bench

int main(int argc, char** argv) {
  using namespace stillpoint;
  using namespace stillpoint::bench;
  cv::setNumThreads(1);
  std::vector<std::string> names(argv + 1, argv + argc);
  if (names.empty())
    names = {"kitchen_walk",          "kitchen_walk+boxes",   "kitchen_box",          "kitchen_static",
             "kitchen_round",         "walking_people",       "walking_people+boxes", "crossing_people",
             "crossing_people+boxes", "person_behind_pillar", "pushed_box",           "static_room"};
  try {
    std::printf(
        "| sequence | object | frames | found, %% | switches | carried 1 s, cm | carried 1 s, deg | speed, m/s | "
        "velocity, m/s | RPE, mm | RPE, deg | frames with movers, %% | share of time, %% |\n"
        "|---|---|---|---|---|---|---|---|---|---|---|---|---|\n");
    for (const std::string& name : names) {
      const std::string scene = name.substr(0, name.find('+'));
      measure(name, sequence_of(scene), scene != name);
    }
  } catch (const std::exception& error) {
    std::fprintf(stderr, "stillpoint_movers: %s\n", error.what());
    return 2;
  }
  return 0;
}
