// SPDX-FileCopyrightText: 2026 The stillpoint authors
// SPDX-License-Identifier: MIT

#include "stillpoint/match/patch_search.hpp"

#include <gtest/gtest.h>

#include <limits>
#include <opencv2/core.hpp>

#include "stillpoint/core/random.hpp"
#include "stillpoint/depth/depth_tolerance.hpp"
#include "stillpoint/match/patch.hpp"
#include "stillpoint/opencv.hpp"
#include "wave_texture.hpp"

namespace stillpoint::patch_test {
namespace {

using test::WaveTexture;

constexpr float kNaN = std::numeric_limits<float>::quiet_NaN();
constexpr float kInfinity = std::numeric_limits<float>::infinity();

template <class Gray>
cv::Mat painted(int width, int height, const Gray& gray) {
  cv::Mat image(height, width, CV_8UC1);
  for (int v = 0; v < height; ++v)
    for (int u = 0; u < width; ++u) image.at<std::uint8_t>(v, u) = static_cast<std::uint8_t>(gray(u, v));
  return image;
}

// ---- Cutting out ----

// A patch at (8, 8) covers 4 … 11, whose mean is 7.5 and whose variance 5.25. 2u + 3v has the mean 37.5 there; without
// it Σ value² = 64 · (4 + 9) · 5.25 = 4368.
TEST(Patch, ItsEnergyIsFreeOfItsMean) {
  const cv::Mat image = painted(20, 20, [](int u, int v) { return 2 * u + 3 * v; });
  Patch patch;
  ASSERT_TRUE(cut_patch(image, {8, 8}, PatchMask(), patch));
  EXPECT_EQ(patch.count, 64);
  EXPECT_EQ(patch.value[0], 20);
  EXPECT_EQ(patch.value[1], 22) << "rows first";
  EXPECT_EQ(patch.value[8], 23);
  EXPECT_EQ(patch.sum, 2400);
  EXPECT_EQ(patch.sum_x, 64 * 4);
  EXPECT_EQ(patch.sum_y, 64 * 6);
  EXPECT_EQ(patch.along_x, 2400 * 4);
  EXPECT_EQ(patch.along_y, 2400 * 6);
  EXPECT_FLOAT_EQ(patch.energy, 4368.0f);
  EXPECT_EQ(patch.hxx, 0.0f) << "gradients are without their mean: a ramp cannot be told from brightness";
  EXPECT_EQ(patch.hyy, 0.0f);
}

// The gradient of u² is 2u, and (u + 1)² − (u − 1)² = 4u twice that; round its mean −7 … 7, Σ = 64 · 4 · 5.25 = 1344.
// Nothing in the other direction.
TEST(Patch, HasTheStructureTensorOfItsGradients) {
  Patch across, along;
  ASSERT_TRUE(cut_patch(painted(16, 16, [](int u, int) { return u * u; }), {8, 8}, PatchMask(), across));
  EXPECT_EQ(across.slope_x[0], 16);
  EXPECT_FLOAT_EQ(across.hxx, 1344.0f);
  EXPECT_EQ(across.hxy, 0.0f);
  EXPECT_EQ(across.hyy, 0.0f);
  ASSERT_TRUE(cut_patch(painted(16, 16, [](int, int v) { return v * v; }), {8, 8}, PatchMask(), along));
  EXPECT_EQ(along.slope_y[0], 16);
  EXPECT_FLOAT_EQ(along.hyy, 1344.0f);
}

// Depth 2 m up to column 7 and 1 m beyond: of the columns 2 … 9 six lie on the centre's surface. Gray is u there, so
// that its mean is (2 + … + 7) / 6 = 4.5, whatever is on the other surface.
TEST(Patch, LeavesOutWhatLiesOnAnotherSurface) {
  const cv::Mat image = painted(20, 20, [](int u, int v) { return u < 8 ? u : 100 + 7 * v; });
  cv::Mat depth(20, 20, CV_32FC1, cv::Scalar(2.0));
  depth.colRange(8, 20).setTo(1.0);
  const DepthView view = DepthView::tum(depth);
  Patch patch;
  ASSERT_TRUE(cut_patch(image, {6, 8}, PatchMask(view, 2.0, 0.08), patch));
  EXPECT_EQ(patch.count, 48);
  for (std::size_t k = 0; k < 64; ++k) EXPECT_EQ(patch.mask[k], k % 8 < 6 ? -1 : 0) << k;
  EXPECT_EQ(patch.sum, 48 * 9 / 2);
  EXPECT_EQ(patch.value[0], 2);
  EXPECT_EQ(patch.value[6], 0);
  EXPECT_EQ(patch.slope_x[7], 0);
  // The centre's own depth gives the same.
  Patch again;
  ASSERT_TRUE(cut_patch(image, {6, 8}, PatchMask(view, Vector2f(6, 8), 0.08), again));
  EXPECT_EQ(again.mask.pixel, patch.mask.pixel);
}

// A tolerance of 0.05 m and five standard deviations of 6.08 mm: 0.0804 m.
TEST(PatchMask, TakesPixelsWithinTheToleranceAndWithoutDepth) {
  constexpr double kTolerance_m = DepthTolerance{0.05, 5.0}.at(0.00608);
  EXPECT_NEAR(kTolerance_m, 0.0804, 1e-12);
  const cv::Mat row = (cv::Mat_<float>(1, 8) << 2.0f, 2.0803f, 2.0805f, 1.9197f, 1.9195f, 0.0f, kInfinity, kNaN);
  const cv::Mat metres = cv::repeat(row, 8, 1);
  cv::Mat tenths;  // of a millimetre
  metres.convertTo(tenths, CV_16U, 10000.0);
  tenths.colRange(6, 8) = 0;
  for (const DepthView& view : {DepthView::tum(metres), DepthView(tenths, 10000.0)}) {
    PatchPixels mask;
    PatchMask(view, 2.0, kTolerance_m).fill(0, 0, mask);
    const int expected[8] = {-1, -1, 0, -1, 0, -1, -1, -1};
    for (std::size_t k = 0; k < 64; ++k) EXPECT_EQ(mask[k], expected[k % 8]) << k;
  }
}

TEST(PatchMask, NeedsADepthAndAnImageOfItsSize) {
  const cv::Mat depth(10, 12, CV_32FC1, cv::Scalar(2.0)), image(10, 12, CV_8UC1), other(20, 24, CV_8UC1);
  const DepthView view = DepthView::tum(depth), none;
  EXPECT_TRUE(PatchMask(view, 2.0, 0.08).applies_to(image));
  EXPECT_FALSE(PatchMask(view, 2.0, 0.08).applies_to(other));
  EXPECT_FALSE(PatchMask(view, 0.0, 0.08).applies_to(image)) << "no depth";
  EXPECT_FALSE(PatchMask(view, Vector2f(12, 3), {}).applies_to(image)) << "outside";
  EXPECT_FALSE(PatchMask(none, Vector2f(3, 3), {}).applies_to(image));
  EXPECT_FALSE(PatchMask().applies_to(image));
}

// A patch reaches from −4 to +3, its gradients one further: 5 pixels from the border are asked for.
TEST(Patch, IsNotCutAtTheBorder) {
  const cv::Mat image = WaveTexture(1).shifted(20, 30, {0, 0});
  Patch patch;
  for (const Vector2f& inside : {Vector2f(5, 5), Vector2f(14, 24), Vector2f(5, 24)})
    EXPECT_TRUE(cut_patch(image, inside, PatchMask(), patch)) << inside.transpose();
  for (const Vector2f& outside : {Vector2f(4, 10), Vector2f(10, 4), Vector2f(15, 10), Vector2f(10, 25),
                                  Vector2f(-50, 10), Vector2f(kNaN, 10), Vector2f(10, kNaN), Vector2f(kInfinity, 10)})
    EXPECT_FALSE(cut_patch(image, outside, PatchMask(), patch)) << outside.transpose();
}

TEST(Patch, NeedsAnImageOfElevenPixels) {
  Patch patch;
  for (const int size : {1, 7, 8, 10})
    for (int centre = 0; centre < size; ++centre)
      EXPECT_FALSE(cut_patch(cv::Mat(size, size, CV_8UC1, cv::Scalar(9)),
                             Vector2f::Constant(static_cast<float>(centre)), PatchMask(), patch));
  EXPECT_TRUE(cut_patch(cv::Mat(11, 11, CV_8UC1, cv::Scalar(9)), {5, 5}, PatchMask(), patch));
  EXPECT_FALSE(cut_patch(ImageView(), {5, 5}, PatchMask(), patch));
}

// ---- Finding again ----

constexpr float kPrecision_px = 0.05f;  // the last step is below 0.03 px; 8-bit rounding adds less
const Vector2f kCentre(60, 40);

Patch cut(const cv::Mat& image) {
  Patch patch;
  EXPECT_TRUE(cut_patch(image, kCentre, PatchMask(), patch));
  return patch;
}

TEST(FindPatch, FindsKnownSubPixelShifts) {
  int found = 0;
  for (std::uint64_t seed = 1; seed <= 20; ++seed) {
    const WaveTexture texture(seed);
    const Patch patch = cut(texture.shifted(120, 90, {0, 0}));
    for (const Vector2d& shift : {Vector2d(0, 0), Vector2d(0.3, -0.6), Vector2d(-1.25, 0.5), Vector2d(0.9, 1.1)}) {
      PatchSearch search;
      search.iterations = 10;
      search.precision_px = 0.01f;
      search.reach_px = 3.0f;
      const PatchFit fit = find_patch(patch, texture.shifted(120, 90, shift), kCentre, search);
      ASSERT_TRUE(fit.inside);
      found += (fit.offset - shift.cast<float>()).norm() < kPrecision_px && fit.dissimilarity < 0.01f;
    }
  }
  EXPECT_GE(found, 72) << "of 80: a smooth patch may have a second valley";
}

TEST(FindPatch, FollowsTurnedAndScaledViews) {
  int found = 0, found_without = 0;
  for (std::uint64_t seed = 1; seed <= 20; ++seed) {
    const WaveTexture texture(seed);
    const Patch patch = cut(texture.shifted(120, 90, {0, 0}));
    const double angle = seed % 2 == 0 ? 0.35 : -0.35, scale = seed % 4 < 2 ? 1.25 : 0.8;
    const Eigen::Matrix2d warp = scale * Eigen::Rotation2Dd(angle).toRotationMatrix();
    const Vector2d shift(0.7, -0.4), centre = kCentre.cast<double>();
    // The texture's point centre + d appears at centre + shift + warp d.
    const cv::Mat other = texture.image(
        120, 90, [&](const Vector2d& x) -> Vector2d { return centre + warp.inverse() * (x - centre - shift); });
    PatchSearch search;
    search.iterations = 10;
    search.precision_px = 0.01f;
    search.warp = warp.cast<float>();
    const PatchFit fit = find_patch(patch, other, kCentre, search);
    found += (fit.offset - shift.cast<float>()).norm() < 2 * kPrecision_px && fit.dissimilarity < 0.02f;
    search.warp.setIdentity();
    const PatchFit plain = find_patch(patch, other, kCentre, search);
    found_without += (plain.offset - shift.cast<float>()).norm() < 2 * kPrecision_px && plain.dissimilarity < 0.02f;
  }
  EXPECT_GE(found, 18) << "of 20";
  EXPECT_LE(found_without, 5) << "the views differ enough for the warp to matter";
}

TEST(FindPatch, BrightnessDoesNotMatter) {
  const WaveTexture texture(3);
  const Patch patch = cut(texture.shifted(120, 90, {0, 0}));
  cv::Mat brighter = texture.shifted(120, 90, {0.8, -0.5}) * 0.5 + cv::Scalar(60);
  const cv::Mat darker = texture.shifted(120, 90, {0.8, -0.5}) - cv::Scalar(25);
  const PatchFit fit = find_patch(patch, darker, kCentre, PatchSearch());
  EXPECT_LT((fit.offset - Vector2f(0.8f, -0.5f)).norm(), 2 * kPrecision_px);
  EXPECT_LT(fit.dissimilarity, 0.01f);
  EXPECT_LT(find_patch(patch, brighter, kCentre + Vector2f(0.8f, -0.5f), PatchSearch()).dissimilarity, 0.02f)
      << "nor does contrast, for how alike they look";
  const PatchFit of_half_contrast = find_patch(patch, brighter, kCentre, PatchSearch());
  EXPECT_LT((of_half_contrast.offset - Vector2f(0.8f, -0.5f)).norm(), 2 * kPrecision_px) << "nor for where it is found";
}

TEST(FindPatch, DissimilarityIsZeroAlikeAndTwoInverted) {
  const cv::Mat image = WaveTexture(4).shifted(120, 90, {0, 0});
  const Patch patch = cut(image);
  PatchSearch one_look;
  one_look.iterations = 1;
  EXPECT_NEAR(find_patch(patch, image, kCentre, one_look).dissimilarity, 0.0f, 1e-3f);
  const cv::Mat inverted = cv::Scalar(255) - image;
  const PatchFit fit = find_patch(patch, inverted, kCentre, one_look);
  EXPECT_TRUE(fit.inside);
  EXPECT_NEAR(fit.dissimilarity, 2.0f, 1e-3f);
  EXPECT_EQ(fit.offset, Vector2f::Zero().eval());
}

TEST(FindPatch, StaysWithinItsReach) {
  for (std::uint64_t seed = 1; seed <= 50; ++seed) {
    const Patch patch = cut(WaveTexture(seed).shifted(120, 90, {0, 0}));
    PatchSearch search;
    search.iterations = 20;
    search.reach_px = 2.0f;
    const PatchFit fit = find_patch(patch, WaveTexture(seed + 100).shifted(120, 90, {0, 0}), kCentre, search);
    EXPECT_LE(fit.offset.norm(), 2.0f + 1e-5f);  // rounding of the scaling
  }
}

TEST(FindPatch, NothingIsFoundOutsideOrNowhere) {
  const cv::Mat image = WaveTexture(5).shifted(120, 90, {0, 0});
  const Patch patch = cut(image);
  PatchSearch turned;
  turned.warp << 0.8f, -0.6f, 0.6f, 0.8f;
  for (const PatchSearch& search : {PatchSearch(), turned}) {
    for (const Vector2f& start :
         {Vector2f(kNaN, 10), Vector2f(10, kNaN), Vector2f(kInfinity, 10), Vector2f(10, -kInfinity), Vector2f(3, 40),
          Vector2f(60, 3), Vector2f(117, 40), Vector2f(60, 87), Vector2f(1e30f, 1e30f), Vector2f(-1e30f, 5)}) {
      const PatchFit fit = find_patch(patch, image, start, search);
      EXPECT_FALSE(fit.inside) << start.transpose();
      EXPECT_EQ(fit.dissimilarity, 2.0f);
      EXPECT_EQ(fit.offset, Vector2f::Zero().eval());
    }
    EXPECT_FALSE(find_patch(patch, ImageView(), kCentre, search).inside);
    EXPECT_FALSE(find_patch(patch, cv::Mat(1, 1, CV_8UC1, cv::Scalar(0)), {0, 0}, search).inside);
  }
  PatchSearch no_warp;
  no_warp.warp.setConstant(kNaN);
  EXPECT_TRUE(find_patch(patch, image, kCentre, no_warp).offset.allFinite());
}

// Neither a flat patch nor an edge says where it is: it stays where the search began.
TEST(FindPatch, APatchWithoutADeterminantStays) {
  const cv::Mat flat(90, 120, CV_8UC1, cv::Scalar(77)),
      edge = painted(120, 90, [](int u, int) { return u < 60 ? 20 : 200; });
  const cv::Mat textured = WaveTexture(6).shifted(120, 90, {0, 0});
  const PatchFit of_flat = find_patch(cut(flat), textured, kCentre, PatchSearch());
  EXPECT_TRUE(of_flat.inside);
  EXPECT_EQ(of_flat.offset, Vector2f::Zero().eval());
  EXPECT_NEAR(of_flat.dissimilarity, 1.0f, 1e-3f) << "nothing to correlate";
  const PatchFit of_edge = find_patch(cut(edge), edge, kCentre + Vector2f(2, 0), PatchSearch());
  EXPECT_TRUE(of_edge.inside);
  EXPECT_EQ(of_edge.offset, Vector2f::Zero().eval());
}

// Only the masked part is compared: the other surface may show anything.
TEST(FindPatch, ComparesTheMaskedPartOnly) {
  const WaveTexture texture(7), background(8);
  cv::Mat here = texture.shifted(120, 90, {0, 0}), there = texture.shifted(120, 90, {0.6, 0.4});
  background.shifted(120, 90, {0, 0}).colRange(62, 120).copyTo(here.colRange(62, 120));
  background.shifted(120, 90, {-7, 3}).colRange(62, 120).copyTo(there.colRange(62, 120));
  cv::Mat depth(90, 120, CV_32FC1, cv::Scalar(1.0));
  depth.colRange(61, 120).setTo(3.0);  // one column of margin for the gradient
  const DepthView view = DepthView::tum(depth);
  Patch masked;
  ASSERT_TRUE(cut_patch(here, kCentre, PatchMask(view, 1.0, {}), masked));
  const PatchFit fit = find_patch(masked, there, kCentre, PatchSearch());
  EXPECT_LT((fit.offset - Vector2f(0.6f, 0.4f)).norm(), 0.15f);
  EXPECT_LT(fit.dissimilarity, 0.05f);
  EXPECT_GT(find_patch(cut(here), there, kCentre, PatchSearch()).dissimilarity, fit.dissimilarity + 0.05f);
}

}  // namespace
}  // namespace stillpoint::patch_test
