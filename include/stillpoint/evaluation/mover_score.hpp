// SPDX-FileCopyrightText: 2026 The stillpoint authors
// SPDX-License-Identifier: MIT
#pragma once

// How well were the movers of a sequence followed, where the pose of every object is known?

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "stillpoint/core/error.hpp"
#include "stillpoint/core/frame_result.hpp"
#include "stillpoint/core/geometry.hpp"
#include "stillpoint/core/span.hpp"
#include "stillpoint/evaluation/error_statistics.hpp"

namespace stillpoint {

/// What is known of an object in one frame.
struct TrueObject {
  Pose world_from_object = Pose::Identity();
  std::size_t moving_features = 0;  ///< the host's features on it, if it moves
};

/// Figures of one object, or of a sequence.
struct MoverFigures {
  std::size_t frames = 0;  ///< in which it moves with at least `MoverScore::kFewestFeatures` features
  std::size_t found = 0;   ///< of them, those with a mover of it that is not lost
  std::size_t switches = 0;
  std::vector<double> carried_m, carried_deg;  ///< error of its pose carried over a second
  std::vector<double> speed_m_s;               ///< error of the speed of the mover's centroid
  std::vector<double> velocity_m_s;            ///< length of the error of its velocity
  std::vector<double> step_m, step_deg;        ///< relative pose error between two frames

  std::optional<double> found_share() const {
    if (frames == 0) return std::nullopt;
    return static_cast<double>(found) / static_cast<double>(frames);
  }
};

/// Sums up a sequence. A mover may be an object's if most of its features lie on it; of several, the one that was the
/// object last remains it, else it is the one with the most (correspondences of CLEAR MOT: Bernardin, Stiefelhagen,
/// "Evaluating Multiple Object Tracking Performance", EURASIP JIVP 2008). So `switches` does not count how often the
/// larger of two parts of an object changes.
class MoverScore {
 public:
  static constexpr std::size_t kFewestFeatures = 20;

  /// @param object_count  in the sequence
  explicit MoverScore(std::size_t object_count) : tracks_(object_count), figures_(object_count) {}

  /// The first frame handed over is left out: nobody can know motion from it.
  /// @param objects     as many as the constructor was told
  /// @param object_of   of each of the host's features: the object on whose pixels it lies, -1 none or not known
  /// @throws Error if the sizes differ
  void add_frame(double timestamp_s, const Pose& world_from_camera, span<const TrueObject> objects,
                 span<const std::int32_t> object_of, const FrameResult& result) {
    if (objects.size() != tracks_.size() || object_of.size() != result.size())
      throw Error("mover score: " + std::to_string(objects.size()) + " objects and " +
                  std::to_string(object_of.size()) + " features, expected " + std::to_string(tracks_.size()) + " and " +
                  std::to_string(result.size()));
    if (frames_seen_++ == 0) return;
    const Pose camera_from_world = inverted(world_from_camera);
    const bool has_motion = judged(result.status());
    frames_ += has_motion;
    frames_with_movers_ += has_motion && !result.movers().empty();
    for (std::size_t o = 0; o < objects.size(); ++o) {
      const Mover* const mover = has_motion ? mover_of(o, tracks_[o].id, object_of, result) : nullptr;
      Moment now;
      now.timestamp_s = timestamp_s;
      now.camera_from_object = camera_from_world * objects[o].world_from_object;
      now.world_from_object = objects[o].world_from_object;
      now.moves = objects[o].moving_features >= kFewestFeatures;
      if (mover != nullptr) {
        now.current_from_reference = mover->current_from_reference;
        now.camera_velocity = mover->velocity;
        now.centroid = mover->centroid;
        now.is_found = true;
      }
      count(o, now, mover, world_from_camera);
      tracks_[o].moments.push_back(now);
    }
  }

  /// Figures of one object; those carried over a second are worked out here.
  MoverFigures figures(std::size_t object) const {
    MoverFigures figures = figures_[object];
    const std::vector<Moment>& moments = tracks_[object].moments;
    for (std::size_t first = 0; first < moments.size(); ++first) carry(moments, first, figures);
    return figures;
  }

  /// Frames that were judged, and of them those with any mover.
  std::size_t frames() const noexcept { return frames_; }
  std::size_t frames_with_movers() const noexcept { return frames_with_movers_; }

 private:
  struct Moment {
    double timestamp_s = 0;
    Pose camera_from_object = Pose::Identity(), world_from_object = Pose::Identity();
    Pose current_from_reference = Pose::Identity();
    Vector3d camera_velocity = Vector3d::Zero(), centroid = Vector3d::Zero();
    bool is_found = false, moves = false;
  };
  struct Track {
    std::vector<Moment> moments;
    std::uint32_t id = 0;  // of the mover that was it last
  };

  static const Mover* mover_of(std::size_t object, std::uint32_t last_id, span<const std::int32_t> object_of,
                               const FrameResult& result) {
    const Mover* best = nullptr;
    std::size_t most = 0;
    for (const Mover& mover : result.movers()) {
      if (mover.state == MoverState::lost) continue;
      std::size_t on_it = 0, on_any = 0;
      for (const std::uint32_t i : result.features(mover)) {
        on_it += object_of[i] == static_cast<std::int32_t>(object);
        on_any += object_of[i] >= 0;
      }
      if (!(2 * on_it > on_any)) continue;
      if (mover.id == last_id) return &mover;
      if (on_it > most) {
        most = on_it;
        best = &mover;
      }
    }
    return best;
  }

  void count(std::size_t o, const Moment& now, const Mover* mover, const Pose& world_from_camera) {
    Track& track = tracks_[o];
    MoverFigures& figures = figures_[o];
    if (now.moves) {
      ++figures.frames;
      figures.found += mover != nullptr;
    }
    if (mover == nullptr) return;
    figures.switches += track.id != 0 && track.id != mover->id;
    track.id = mover->id;
    if (!now.moves || track.moments.empty()) return;
    const Moment& last = track.moments.back();
    const double elapsed_s = now.timestamp_s - last.timestamp_s;
    if (!(elapsed_s > 0)) return;
    // The world's velocity of the point of the object that is at the mover's centroid now.
    const Vector3d centroid = world_from_camera * now.centroid;
    const Vector3d before = last.world_from_object * (inverted(now.world_from_object) * centroid);
    const Vector3d velocity = (centroid - before) / elapsed_s;
    const Vector3d estimate = world_from_camera.linear() * now.camera_velocity;
    figures.speed_m_s.push_back(std::abs(estimate.norm() - velocity.norm()));
    figures.velocity_m_s.push_back((estimate - velocity).norm());
    const Pose estimated = inverted(now.camera_from_object) * now.current_from_reference * last.camera_from_object;
    figures.step_m.push_back(estimated.translation().norm());
    figures.step_deg.push_back(degrees(estimated));
  }

  /// The true pose of one moment, carried on by the estimated motions for a second.
  static void carry(const std::vector<Moment>& moments, std::size_t first, MoverFigures& figures) {
    constexpr double kSecond_s = 1.0, kRounding_s = 1e-3;
    if (!moments[first].moves || !moments[first].is_found) return;
    Pose camera_from_object = moments[first].camera_from_object;
    for (std::size_t k = first + 1; k < moments.size() && moments[k].is_found; ++k) {
      camera_from_object = moments[k].current_from_reference * camera_from_object;
      if (moments[k].timestamp_s - moments[first].timestamp_s < kSecond_s - kRounding_s) continue;
      const Pose error = inverted(moments[k].camera_from_object) * camera_from_object;
      figures.carried_m.push_back(error.translation().norm());
      figures.carried_deg.push_back(degrees(error));
      return;
    }
  }

  static double degrees(const Pose& pose) { return kDegreesPerRadian * rotation_angle(pose.linear()); }

  std::vector<Track> tracks_;
  std::vector<MoverFigures> figures_;
  std::size_t frames_seen_ = 0, frames_ = 0, frames_with_movers_ = 0;
};

}  // namespace stillpoint
