// SPDX-FileCopyrightText: 2026 The stillpoint authors
// SPDX-License-Identifier: MIT
#pragma once

// VINS-Mono, VINS-Fusion and front ends like theirs: tracked points with ids.   One of three is enough:
//
//   mask      paint_mask_255_is_free    in FeatureTracker::setMask: ends tracks, and begins none there
//   tracks    compact_tracks            in FeatureTracker::trackImage, before setMask
//   features  dropped_ids,              before Estimator::inputFeature, or for Estimator::removeOutliers
//             erase_features
//
// The host tests its mask for 255 exactly. No header of the host is included: members are meant by name.

#include <cstddef>
#include <cstdint>
#include <opencv2/core/mat.hpp>
#include <string>

#include "stillpoint/adapters/host_arrays.hpp"
#include "stillpoint/adapters/host_masks.hpp"
#include "stillpoint/core/error.hpp"
#include "stillpoint/core/image.hpp"
#include "stillpoint/core/span.hpp"

namespace stillpoint::vins {

namespace detail {

// clang-format off
/// What `compact_tracks` touches. One message, for the first member that is missing.
template <class Tracker>
struct TrackerContract {
  static constexpr bool kPoints = offers<Tracker>([](auto& tracker) -> decltype(void(tracker.cur_pts)) {});
  static constexpr bool kIds = kPoints && offers<Tracker>([](auto& tracker) -> decltype(void(tracker.ids)) {});
  static constexpr bool kCounts = kIds && offers<Tracker>([](auto& tracker) -> decltype(void(tracker.track_cnt)) {});
  static_assert(kPoints, "stillpoint: a VINS FeatureTracker must have cur_pts, the tracked pixels; see adapters/vins.hpp");
  static_assert(!kPoints || kIds, "stillpoint: a VINS FeatureTracker must have ids, one a tracked pixel; see adapters/vins.hpp");
  static_assert(!kIds || kCounts, "stillpoint: a VINS FeatureTracker must have track_cnt, one a tracked pixel; see adapters/vins.hpp");
  static constexpr bool holds = kCounts;
};
// clang-format on

template <class FeatureFrame>
constexpr bool is_ordered_map = offers<FeatureFrame>([](auto& f) -> decltype(void(f.key_comp()),
                                                                             void(f.erase(f.begin())),
                                                                             void(f.begin()->first)) {});

}  // namespace detail

/// Paints 0 where the mask drops, and leaves the rest of the host's mask as it is: right after setMask has made it
/// white (255), or copied a fisheye's.
/// @param mask       gray8 of the host mask's size, 255 keeps, 0 drops
/// @param host_mask  CV_8UC1, 255 is free
/// @throws Error if the mask has another size or format; then the host's is unchanged
inline void paint_mask_255_is_free(const ImageView& mask, cv::Mat& host_mask) {
  require_mask_of_size("vins", mask, host_mask.cols, host_mask.rows);
  host_mask.setTo(0, mask_255_drops(mask));
}

/// Compacts cur_pts, ids and track_cnt together, in order.
/// @param keep     one byte a point of cur_pts, 0 drops
/// @param tracker  the host's FeatureTracker
/// @param more     arrays of a fork with one entry a point; in trackImage before setMask prev_pts is one
/// @return how many are left
/// @throws Error that names the array if one has another size than `keep`; then nothing was changed. O(n).
template <class Tracker, class... MoreArrays>
std::size_t compact_tracks(span<const std::uint8_t> keep, Tracker& tracker, MoreArrays&... more) {
  if constexpr (detail::TrackerContract<Tracker>::holds) {
    return compact_host_arrays("vins", keep, host_array("cur_pts", tracker.cur_pts), host_array("ids", tracker.ids),
                               host_array("track_cnt", tracker.track_cnt), host_array("a further array", more)...);
  } else {
    return 0;  // the contract has said what is missing: no second error
  }
}

/// Adds the ids of what was dropped to a set, as Estimator::removeOutliers takes it.
/// @param keep     one byte per feature, 0 drops
/// @param ids      the features' ids, in the order of the flags
/// @param dropped  what is in it stays
/// @throws Error if there is not one id a flag
template <class Ids, class IdSet>
void dropped_ids(span<const std::uint8_t> keep, const Ids& ids, IdSet& dropped) {
  if (ids.size() != keep.size())
    throw Error("vins: " + std::to_string(ids.size()) + " ids, expected one for each of the " +
                std::to_string(keep.size()) + " keep flags");
  for (std::size_t i = 0; i < keep.size(); ++i)
    if (keep[i] == 0) dropped.insert(dropped.end(), ids[i]);  // ids mostly grow: the end is a good hint
}

/// Erases features from what Estimator::inputFeature takes, map<id, observations>. One walk over both, O(n + m).
/// @param dropped        ids, ascending: std::set<int>, or a sorted vector
/// @param feature_frame  std::map from id to observations
/// @return how many were erased; ids that are not in the frame are passed over
template <class IdSet, class FeatureFrame>
std::size_t erase_features(const IdSet& dropped, FeatureFrame& feature_frame) {
  static_assert(detail::is_ordered_map<FeatureFrame>,
                "stillpoint: a VINS feature frame must be a std::map from id to observations; see adapters/vins.hpp");
  std::size_t erased = 0;
  if constexpr (detail::is_ordered_map<FeatureFrame>) {
    auto id = dropped.begin();
    for (auto feature = feature_frame.begin(); feature != feature_frame.end() && id != dropped.end();) {
      if (feature->first < *id) {
        ++feature;
      } else if (*id < feature->first) {
        ++id;
      } else {
        feature = feature_frame.erase(feature);
        ++erased;
      }
    }
  }
  return erased;
}

}  // namespace stillpoint::vins
