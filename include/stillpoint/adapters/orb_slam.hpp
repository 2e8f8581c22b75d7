// SPDX-FileCopyrightText: 2026 The stillpoint authors
// SPDX-License-Identifier: MIT
#pragma once

// ORB-SLAM2, ORB-SLAM3 and forks: what their Frame, extractor and optimiser take of the filter.   docs/adopting.md says
// where each call goes, with function and line. No header of the host is included: members are meant by name.
//
//   extractor   erase_masked_candidates, features_to_extract   before the features are chosen
//   hook B      compact_after_extraction                       right after ExtractORB, before N is set
//   hook A      compact_after_depth                            after ComputeStereoFromRGBD, before mvpMapPoints
//   hook C      compact_frame                                  in Tracking, between the Frame and Track()
//   optimiser   weighted_inv_sigma2                            where drops are not wanted
//
// docs/hosts/orb_slam3.diff is the whole change of a host by hook C.
//
// A Frame without features is half-initialised: flags that would drop all drop none.

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <opencv2/core/mat.hpp>
#include <string>
#include <vector>

#include "stillpoint/adapters/host_arrays.hpp"
#include "stillpoint/adapters/host_masks.hpp"
#include "stillpoint/core/camera.hpp"
#include "stillpoint/core/error.hpp"
#include "stillpoint/core/span.hpp"
#include "stillpoint/verdict/keep_flags.hpp"
#include "stillpoint/verdict/keep_floor.hpp"

namespace stillpoint::orb_slam {

namespace detail {

/// Compacts, unless nothing would be left.
template <class... Arrays>
std::size_t compact_unless_all(span<const std::uint8_t> keep, const HostArray<Arrays>&... arrays) {
  require_aligned_host_arrays("orb_slam", keep, arrays...);
  return kept_count(keep) == 0 ? keep.size() : compact_host_arrays("orb_slam", keep, arrays...);
}

// clang-format off
/// What hook B touches. One message, for the first member that is missing.
template <class Frame>
struct FrameAtExtraction {
  static constexpr bool kKeys = offers<Frame>([](auto& frame) -> decltype(void(frame.mvKeys)) {});
  static constexpr bool holds = kKeys && offers<Frame>([](auto& frame) -> decltype(void(frame.mDescriptors)) {});
  static_assert(kKeys, "stillpoint: an ORB-SLAM Frame must have mvKeys, a vector of keypoints; see adapters/orb_slam.hpp");
  static_assert(!kKeys || holds, "stillpoint: an ORB-SLAM Frame must have mDescriptors, one row a keypoint; see adapters/orb_slam.hpp");
};

/// What hook A touches.
template <class Frame>
struct FrameWithDepth {
  static constexpr bool kBase = FrameAtExtraction<Frame>::holds;
  static constexpr bool kKeysUn = kBase && offers<Frame>([](auto& frame) -> decltype(void(frame.mvKeysUn)) {});
  static constexpr bool kRight = kKeysUn && offers<Frame>([](auto& frame) -> decltype(void(frame.mvuRight)) {});
  static constexpr bool kDepth = kRight && offers<Frame>([](auto& frame) -> decltype(void(frame.mvDepth)) {});
  static constexpr bool holds = kDepth && offers<Frame>([](auto& frame) -> decltype(void(frame.N = 0)) {});
  static_assert(!kBase || kKeysUn, "stillpoint: an ORB-SLAM Frame must have mvKeysUn, the undistorted mvKeys; see adapters/orb_slam.hpp");
  static_assert(!kKeysUn || kRight, "stillpoint: an ORB-SLAM Frame must have mvuRight, one float per keypoint; see adapters/orb_slam.hpp");
  static_assert(!kRight || kDepth, "stillpoint: an ORB-SLAM Frame must have mvDepth, one float per keypoint; see adapters/orb_slam.hpp");
  static_assert(!kDepth || holds, "stillpoint: an ORB-SLAM Frame must have N, the number of keypoints; see adapters/orb_slam.hpp");
};
// clang-format on

/// What hook C touches beside that.
template <class Frame>
constexpr bool is_finished_frame = offers<Frame>([](auto& frame) -> decltype(  //
                                                                     void(frame.mvpMapPoints), void(frame.mvbOutlier),
                                                                     void(frame.mGrid[0][0].size())) {});

}  // namespace detail

/// Hook A: compacts mvKeys, mvKeysUn, mvuRight, mvDepth and the rows of mDescriptors together, in order, and sets N.
/// Call it when all of them are filled and nothing else is sized by N: in the RGB-D constructor after
/// ComputeStereoFromRGBD, in that for rectified stereo after ComputeStereoMatches.
/// @param keep   one byte per keypoint, 0 drops; all 0 drops none
/// @param frame  the host's Frame
/// @param more   arrays of a fork with one entry per keypoint
/// @return the new N
/// @throws Error that names the array if one has another size than `keep`; then nothing was changed. O(N).
template <class Frame, class... MoreArrays>
std::size_t compact_after_depth(span<const std::uint8_t> keep, Frame& frame, MoreArrays&... more) {
  if constexpr (detail::FrameWithDepth<Frame>::holds) {
    if (keep.size() > 0 && frame.mvKeysUn.empty() && !frame.mvKeys.empty())
      throw Error(
          "orb_slam: mvKeysUn is empty, which is so in a Frame of two fisheye cameras; expected one entry per "
          "keypoint, "
          "or compact_mono_first for each camera after extraction");
    const std::size_t kept = detail::compact_unless_all(
        keep, host_array("mvKeys", frame.mvKeys), host_array("mvKeysUn", frame.mvKeysUn),
        host_array("mvuRight", frame.mvuRight), host_array("mvDepth", frame.mvDepth),
        host_array("mDescriptors", frame.mDescriptors), host_array("a further array", more)...);
    frame.N = static_cast<decltype(frame.N)>(kept);
    return kept;
  } else {
    return 0;  // the contract has said what is missing: no second error
  }
}

/// Hook B: compacts mvKeys and the rows of mDescriptors; the host derives the rest, N too, from them.
/// Call it right after ExtractORB.
/// @param keep   one byte per keypoint, 0 drops; all 0 drops none
/// @param frame  the host's Frame
/// @param more   arrays of a fork with one entry per keypoint
/// @return how many are left
/// @throws Error as `compact_after_depth`. O(N).
template <class Frame, class... MoreArrays>
std::size_t compact_after_extraction(span<const std::uint8_t> keep, Frame& frame, MoreArrays&... more) {
  if constexpr (detail::FrameAtExtraction<Frame>::holds) {
    return detail::compact_unless_all(keep, host_array("mvKeys", frame.mvKeys),
                                      host_array("mDescriptors", frame.mDescriptors),
                                      host_array("a further array", more)...);
  } else {
    return 0;
  }
}

/// Hook B for one of two fisheye cameras (ORB-SLAM3), whose keypoints outside of the common view come first: mvKeys,
/// mDescriptors, monoLeft, or mvKeysRight, mDescriptorsRight, monoRight. Before Nleft and Nright are set.
/// @param keep         one byte per keypoint of this camera, 0 drops; all 0 drops none
/// @param keypoints    of this camera
/// @param descriptors  one row a keypoint
/// @param mono_count   how many come first; recounted
/// @return how many are left
/// @throws Error as `compact_after_depth`, and if `mono_count` is no number of keypoints. O(N).
template <class Keypoints, class Descriptors>
std::size_t compact_mono_first(span<const std::uint8_t> keep, Keypoints& keypoints, Descriptors& descriptors,
                               int& mono_count) {
  if (mono_count < 0 || static_cast<std::size_t>(mono_count) > keep.size())
    throw Error("orb_slam: mono_count is " + std::to_string(mono_count) + ", expected 0 to the " +
                std::to_string(keep.size()) + " keypoints of the camera");
  const std::size_t kept =
      detail::compact_unless_all(keep, host_array("keypoints", keypoints), host_array("descriptors", descriptors));
  if (kept_count(keep) > 0) mono_count = static_cast<int>(kept_count(keep.first(static_cast<std::size_t>(mono_count))));
  return kept;
}

/// Hook C: compacts a finished Frame, so that the host's Frame need not know the filter: the arrays of hook A,
/// mvpMapPoints and mvbOutlier together, in order; mGrid gets the new indices, N the new number. The Frame is as if
/// hook A had compacted it while it was made. Call it between `mCurrentFrame = Frame(...)` and `Track()`.
/// @param keep   one byte per keypoint, 0 drops; all 0 drops none
/// @param frame  the host's Frame, of one RGB-D camera
/// @param more   arrays of a fork with one entry per keypoint
/// @return the new N
/// @throws Error as `compact_after_depth`. O(N), one allocation.
template <class Frame, class... MoreArrays>
std::size_t compact_frame(span<const std::uint8_t> keep, Frame& frame, MoreArrays&... more) {
  static_assert(detail::is_finished_frame<Frame>,
                "stillpoint: an ORB-SLAM Frame must have mvpMapPoints, mvbOutlier and mGrid, columns of rows of "
                "indices; see adapters/orb_slam.hpp");
  if constexpr (detail::is_finished_frame<Frame>) {
    require_aligned_host_arrays("orb_slam", keep, host_array("mvpMapPoints", frame.mvpMapPoints),
                                host_array("mvbOutlier", frame.mvbOutlier));
    const std::size_t kept = compact_after_depth(keep, frame, more...);
    if (kept == keep.size()) return kept;
    compact(keep, frame.mvpMapPoints, frame.mvbOutlier);
    std::vector<int> old_to_new;
    compaction_map(keep, old_to_new);
    reindex_grid(frame.mGrid, old_to_new);
    return kept;
  } else {
    return 0;
  }
}

/// How much must be left for the host. Tracking::StereoInitialization wants more than 500 features, counted with and
/// without depth, and is silent below; later TrackLocalMap wants 30 inliers, and 50 soon after a relocalisation.
/// @param is_initialised  is there a map already?
inline KeepFloor::Options keep_floor(bool is_initialised) {
  KeepFloor::Options options;
  options.fewest_features = is_initialised ? 50 : 501;
  return options;
}

/// How many features to ask the extractor for, so that about `wanted` are left when those in a share of the image go.
/// @param wanted              how many shall be left
/// @param dropped_area_share  0 to 1, of the image that is likely to be dropped; NaN counts as 0
/// @param most_factor         never more than this times `wanted`, 1 or more; forks take 1.5 (NGD-SLAM) to 2.2
///                            (Crowd-SLAM)
inline int features_to_extract(int wanted, double dropped_area_share, double most_factor = 2.0) {
  const double left = dropped_area_share > 0.0 ? 1.0 - dropped_area_share : 1.0;
  const double fewest_left = 1.0 / std::max(1.0, most_factor);
  return static_cast<int>(std::ceil(wanted / std::max(left, fewest_left)));
}

/// Erases the candidates under a mask before DistributeOctTree shares out the budget among them: the features that are
/// left then all stand where the mask keeps. Stable, one pass. Nothing left is no harm here.
/// @param mask        gray8 of the image's size, 255 keeps, 0 drops; an empty one drops nothing
/// @param candidates  vToDistributeKeys of one pyramid level: keypoints counted from that level's border
/// @param border_px   minBorderX and minBorderY, pixels of the level
/// @param scale       mvScaleFactor[level]
/// @throws Error if the mask is neither empty nor gray8
template <class Candidates>
void erase_masked_candidates(const ImageView& mask, Candidates& candidates, int border_px, double scale) {
  if (mask.empty()) return;
  require_mask("orb_slam", mask);
  const auto border = static_cast<float>(border_px), factor = static_cast<float>(scale);
  const auto is_dropped = [&](const auto& candidate) {
    return mask_drops(mask, Vector2f((candidate.pt.x + border) * factor, (candidate.pt.y + border) * factor));
  };
  candidates.erase(std::remove_if(candidates.begin(), candidates.end(), is_dropped), candidates.end());
}

/// invSigma2 of an edge in Optimizer::PoseOptimization, times what the filter thinks of its feature.
/// @param inv_sigma2  the host's, of the keypoint's pyramid level
/// @param weights     one per keypoint as `stillpoint::weights` gives them, 0 to 1; empty: all are 1
/// @param i           the keypoint
/// @param least       lowest weight: an edge without information has no error and passes for an inlier
template <class Scalar>
Scalar weighted_inv_sigma2(Scalar inv_sigma2, span<const float> weights, std::size_t i, float least = 0.05f) {
  const float weight = weights.empty() ? 1.0f : weights[i] > least ? std::min(weights[i], 1.0f) : least;  // NaN: least
  return inv_sigma2 * static_cast<Scalar>(weight);
}

/// The filter's camera, of what the Frame's constructor is given: its static fx, fy, cx and cy are not set in the first
/// frame.
/// @param K           3x3 float
/// @param distortion  mDistCoef: k1 k2 p1 p2 and perhaps k3, float; empty: none
/// @param width       pixels of the image
/// @param height      pixels of the image
/// @throws Error if they have another size or type, or no camera comes of them
inline Camera camera(const cv::Mat& K, const cv::Mat& distortion, int width, int height) {
  if (K.type() != CV_32FC1 || K.rows != 3 || K.cols != 3)
    throw Error("orb_slam: K has " + std::to_string(K.rows) + "x" + std::to_string(K.cols) + " values of type " +
                std::to_string(K.type()) + ", expected 3x3 float");
  const std::size_t count = distortion.total();
  if (count != 0 && (distortion.type() != CV_32FC1 || (count != 4 && count != 5)))
    throw Error("orb_slam: mDistCoef has " + std::to_string(count) + " values of type " +
                std::to_string(distortion.type()) + ", expected 4 or 5 floats");
  const auto coefficient = [&](int i) -> double {
    return static_cast<std::size_t>(i) < count ? static_cast<double>(distortion.at<float>(i)) : 0.0;
  };
  AnyDistortion lens;
  if (count != 0)
    lens.model = BrownConrady{coefficient(0), coefficient(1), coefficient(2), coefficient(3), coefficient(4)};
  const auto intrinsic = [&K](int row, int column) { return static_cast<double>(K.at<float>(row, column)); };
  return Camera(intrinsic(0, 0), intrinsic(1, 1), intrinsic(0, 2), intrinsic(1, 2), width, height, lens);
}

}  // namespace stillpoint::orb_slam
