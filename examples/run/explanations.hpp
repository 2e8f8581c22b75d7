// SPDX-FileCopyrightText: 2026 The stillpoint authors
// SPDX-License-Identifier: MIT
#pragma once

// What each term of the report means, in one sentence: it stands beside the term.

#include "stillpoint/core/score.hpp"
#include "stillpoint/core/status.hpp"
#include "stillpoint/core/timings.hpp"
#include "stillpoint/core/warnings.hpp"

namespace stillpoint_run {

constexpr const char* explained(stillpoint::Status status) noexcept {
  using stillpoint::Status;
  switch (status) {
    case Status::ok: return "The frame was judged.";
    case Status::first_frame: return "Nothing to compare with yet; all features are kept.";
    case Status::no_image: return "The image is empty; all features are kept.";
    case Status::unsupported_image: return "Image or depth of a type that cannot be read; all features are kept.";
    case Status::depth_unit_missing: return "16-bit depth without a unit; all features are kept.";
    case Status::implausible_depth: return "Half of the depths are beyond a kilometre; all features are kept.";
    case Status::size_changed: return "The image is not of the camera's size; all features are kept.";
    case Status::invalid_time: return "The timestamp is not a time in seconds; all features are kept.";
    case Status::invalid_options: return "An option is out of its range; all features are kept.";
    case Status::duplicate_frame: return "The timestamp of the last frame again; all features are kept.";
    case Status::out_of_order: return "Time runs backwards: the filter begins anew here; all features are kept.";
    case Status::time_gap: return "Too long since the last frame: the filter begins anew here; all features are kept.";
    case Status::no_keypoints: return "The extractor found no feature.";
    case Status::no_depth: return "No usable depth in this frame or the last; all features are kept.";
    case Status::too_few_matches: return "Too few matches to find the camera's motion; all features are kept.";
    case Status::degenerate_geometry: return "The matches do not determine the camera's motion; all features are kept.";
    case Status::no_consensus: return "No motion of the camera explains enough of the matches; all features are kept.";
  }
  return "";
}

constexpr const char* explained(stillpoint::Warning warning) noexcept {
  using stillpoint::Warning;
  switch (warning) {
    case Warning::rotation_only: return "The camera rotated without translation, or did not move.";
    case Warning::consensus_inverted:
      return "Another rigid motion explains more features; the one that agrees with the past was taken.";
    case Warning::keep_floor: return "So many features were dynamic that some were kept all the same.";
    case Warning::depth_turned_over: return "The depth fits the image better when it is mirrored or upside down.";
    case Warning::depth_too_near: return "Hardly a depth beyond 1 m: is the unit of the depth right?";
    case Warning::motion_too_fast: return "More than two metres per frame: are the units of depth and time right?";
    case Warning::scale_differs: return "The poses given to the filter move at another scale than the depth.";
    case Warning::keypoints_in_one_quarter: return "All keypoints are in one quarter of the image.";
    case Warning::keypoints_outside: return "Half of the keypoints are outside of the image.";
    case Warning::times_far_apart: return "Nearly every frame comes too late for the last one, or before it.";
    case Warning::depth_unsynchronised: return "Depth images are older or newer than their images: pair them by time.";
    case Warning::depth_shape_differs: return "The depth image has another shape than the image: is it aligned?";
    case Warning::principal_point_aside: return "The principal point is far from the middle of the image.";
    case Warning::depth_shifted: return "Depth images lie some pixels beside their images: are both calibrated?";
    case Warning::nothing_fits: return "Hardly a frame can be judged: are depth and image aligned?";
  }
  return "";
}

constexpr const char* explained(stillpoint::Reason reason) noexcept {
  using stillpoint::Reason;
  switch (reason) {
    case Reason::not_judged: return "the frame was not judged: see its status";
    case Reason::outside_regions: return "outside of dynamic boxes, where nothing is tested";
    case Reason::static_cluster: return "its cluster agrees with the camera's motion";
    case Reason::moving_cluster: return "its cluster does not agree with the camera's motion";
    case Reason::consistent: return "it agrees with the camera's motion";
    case Reason::inconsistent: return "it does not agree with the camera's motion";
    case Reason::neighbours: return "its neighbours on the same surface decided";
    case Reason::remembered: return "earlier frames decided";
    case Reason::no_match: return "it was not found in the reference frame";
    case Reason::no_depth: return "it has no depth here or in the reference frame";
    case Reason::outside_image: return "its keypoint is outside of the image";
    case Reason::keep_floor: return "dynamic, but kept, because too few would be left";
    case Reason::object_motion: return "the motion of the object that it lies on decided";
  }
  return "";
}

constexpr const char* explained(stillpoint::Stage stage) noexcept {
  using stillpoint::Stage;
  switch (stage) {
    case Stage::prior: return "boxes and masks of a detector, carried to this frame";
    case Stage::match: return "features and support corners are found again in earlier frames";
    case Stage::motion: return "the camera's own motion is estimated";
    case Stage::score: return "how badly each feature disagrees with that motion";
    case Stage::gate: return "which disagreement is more than noise";
    case Stage::classify: return "features of one surface share their evidence";
    case Stage::memory: return "evidence of earlier frames is added";
    case Stage::verdict: return "keep or drop, and the keep-floor";
    case Stage::movers: return "dynamic features become objects that are followed";
  }
  return "";
}

}  // namespace stillpoint_run
