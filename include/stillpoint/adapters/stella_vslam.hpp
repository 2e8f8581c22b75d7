// SPDX-FileCopyrightText: 2026 The stillpoint authors
// SPDX-License-Identifier: MIT
#pragma once

// stella_vslam takes the filter's answer in three ways, the last two without a patch.   docs/hosts/other_hosts.md has
// the whole of it.
//
//   patch      camera, keep_floor       in create_RGBD_frame: docs/hosts/stella_vslam.diff
//   keypoints  compact_observation      between create_RGBD_frame and feed_frame: drops no neighbours of dynamic ones
//   mask       frame_mask_0_drops       feed_RGBD_frame(rgb, depth, timestamp, mask): before the features are chosen
//
// A mask costs more than what it covers: a cell of 64 pixels of the pyramid level is skipped whole where one of its
// corners is dropped. No header of the host is included: members are meant by name.

#include <cstddef>
#include <cstdint>
#include <opencv2/core/mat.hpp>
#include <vector>

#include "stillpoint/adapters/host_arrays.hpp"
#include "stillpoint/adapters/host_masks.hpp"
#include "stillpoint/core/camera.hpp"
#include "stillpoint/core/span.hpp"
#include "stillpoint/verdict/keep_floor.hpp"

namespace stillpoint::stella_vslam {

namespace detail {

template <class Observation>
constexpr bool is_observation = offers<Observation>([](auto& o) -> decltype(  //
                                                                    void(o.descriptors_), void(o.undist_keypts_),
                                                                    void(o.bearings_), void(o.stereo_x_right_),
                                                                    void(o.depths_),
                                                                    void(o.keypt_indices_in_cells_)) {});

template <class HostCamera>
constexpr bool is_fisheye = offers<HostCamera>([](auto& camera) -> decltype(void(camera.k4_)) {});

}  // namespace detail

/// The filter's camera.
/// @param host  camera::perspective or camera::fisheye
/// @throws Error if its values are none of a camera
template <class HostCamera>
Camera camera(const HostCamera& host) {
  AnyDistortion lens;
  if constexpr (detail::is_fisheye<const HostCamera>)
    lens.model = EquidistantFisheye{host.k1_, host.k2_, host.k3_, host.k4_};
  else if (host.k1_ != 0 || host.k2_ != 0 || host.p1_ != 0 || host.p2_ != 0 || host.k3_ != 0)
    lens.model = BrownConrady{host.k1_, host.k2_, host.p1_, host.p2_, host.k3_};
  return Camera(host.fx_, host.fy_, host.cx_, host.cy_, static_cast<int>(host.cols_), static_cast<int>(host.rows_),
                lens);
}

/// The last argument of feed_RGBD_frame and its like: 0 drops, 255 keeps, which is the filter's own polarity. It takes
/// the place of mask_rectangles in the host's configuration. The host checks nothing but the type, and that by assert.
/// @param mask          gray8 of the image's size, 255 keeps
/// @param image_width   pixels
/// @param image_height  pixels
/// @throws Error if it is not
inline cv::Mat frame_mask_0_drops(const ImageView& mask, int image_width, int image_height) {
  require_mask_of_size("stella_vslam", mask, image_width, image_height);
  return mask_255_keeps(mask);
}

/// Compacts descriptors_, undist_keypts_, bearings_, stereo_x_right_ and depths_ together, in order (the last two are
/// empty in a monocular frame), and gives keypt_indices_in_cells_ the new indices. The host's own
/// assign_keypoints_to_grid appends to what the cells hold: it would have to find them empty.
/// @param keep         one byte per keypoint, 0 drops
/// @param observation  frm_obs_ of the frame; construct a new frame of it, whose landmarks have its size
/// @param old_to_new   becomes the map of indices, for arrays of your own; its memory is reused
/// @return how many are left
/// @throws Error that names the array if one has another size than `keep`; then nothing was changed. O(n).
template <class Observation>
std::size_t compact_observation(span<const std::uint8_t> keep, Observation& observation, std::vector<int>& old_to_new) {
  static_assert(detail::is_observation<Observation>,
                "stillpoint: a stella_vslam frame_observation must have descriptors_, undist_keypts_, bearings_, "
                "stereo_x_right_, depths_ and keypt_indices_in_cells_; see adapters/stella_vslam.hpp");
  if constexpr (detail::is_observation<Observation>) {
    const std::size_t kept = compact_host_arrays(
        "stella_vslam", keep, host_array("descriptors_", observation.descriptors_),
        host_array("undist_keypts_", observation.undist_keypts_), host_array("bearings_", observation.bearings_),
        optional_host_array("stereo_x_right_", observation.stereo_x_right_),
        optional_host_array("depths_", observation.depths_));
    compaction_map(keep, old_to_new);
    reindex_grid(observation.keypt_indices_in_cells_, old_to_new);
    return kept;
  } else {
    return 0;  // the contract has said what is missing: no second error
  }
}

/// How much must be left for the host: it starts with 50 valid depths (Initializer.min_num_triangulated_pts) and tracks
/// with 20 matches. Twice as many here, because not every feature has a depth or finds its match.
/// @param is_initialised  is there a map already?
inline KeepFloor::Options keep_floor(bool is_initialised) {
  KeepFloor::Options options;
  options.fewest_features = is_initialised ? 40 : 100;
  return options;
}

}  // namespace stillpoint::stella_vslam
