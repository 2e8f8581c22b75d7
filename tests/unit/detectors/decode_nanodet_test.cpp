// SPDX-FileCopyrightText: 2026 The stillpoint authors
// SPDX-License-Identifier: MIT

#include "stillpoint/detectors/decode_nanodet.hpp"

#include <cmath>
#include <limits>

#include "unit/detectors/made_tensor.hpp"

namespace stillpoint::decode_nanodet_test {
namespace {

// Input 64x64: 64, 16, 4 and 1 cells of strides 8, 16, 32, 64. Three classes; 8 bins a side.
const DecodeSettings kSettings{{64, 64}, 3, 0.4f};
constexpr float kSure = 50.0f;  // against zeros its softmax is 1

struct Heads {
  MadeTensor scores[4] = {MadeTensor({64, 3}), MadeTensor({16, 3}), MadeTensor({4, 3}), MadeTensor({1, 3})};
  MadeTensor sides[4] = {MadeTensor({64, 32}), MadeTensor({16, 32}), MadeTensor({4, 32}), MadeTensor({1, 32})};
  Heads() {
    // Stride 16, cell 6: column 2, row 1. Bins 1, 0, 2 surely, and 0 and 1 alike: 0.5 in the mean.
    scores[1].at({6, 1}) = 0.7f;
    sides[1].at({6, 1}) = sides[1].at({6, 8 + 0}) = sides[1].at({6, 16 + 2}) = kSure;
    sides[1].at({6, 24 + 0}) = sides[1].at({6, 24 + 1}) = kSure;
  }
};

TEST(DecodeNanoDet, DistancesAreMeansOverBins) {
  const Heads heads;
  std::vector<RawDetection> found;
  // In another order than by stride, and scores behind distances.
  decode_nanodet(
      views(heads.sides[2], heads.sides[0], heads.scores[1], heads.sides[1], heads.scores[0], heads.scores[2]),
      kSettings, kNanoDetMiddle, found);
  ASSERT_EQ(found.size(), 1u);
  // Middle (2·16 + 7.5, 16 + 7.5) = (39.5, 23.5); left 16, top 0, right 32, bottom 8.
  expect_box(found[0], 23.5f, 23.5f, 71.5f, 31.5f);
  EXPECT_EQ(found[0].label, 1);
  EXPECT_NEAR(found[0].score, 0.7f, 1e-6f);
}

TEST(DecodeNanoDet, PicoDetHasAFourthStrideAndMiddlesHalfAPixelFurther) {
  Heads heads;
  heads.scores[3].at({0, 2}) = 0.9f;  // all bins alike: their mean 3.5, times 64 is 224, about (32, 32)
  std::vector<RawDetection> found;
  decode_nanodet(views(heads.scores[0], heads.scores[1], heads.scores[2], heads.scores[3], heads.sides[0],
                       heads.sides[1], heads.sides[2], heads.sides[3]),
                 kSettings, kPicoDetMiddle, found);
  ASSERT_EQ(found.size(), 2u);
  expect_box(found[0], 24, 24, 72, 32);
  expect_box(found[1], 32 - 224, 32 - 224, 32 + 224, 32 + 224);
}

TEST(DecodeNanoDet, ABatchOfOneMayLead) {
  const Heads heads;
  const auto with_batch = [](const MadeTensor& flat) {
    MadeTensor batch({1, flat.shape[0], flat.shape[1]});
    batch.values = flat.values;
    return batch;
  };
  const MadeTensor a = with_batch(heads.scores[0]), b = with_batch(heads.scores[1]), c = with_batch(heads.scores[2]),
                   d = with_batch(heads.sides[0]), e = with_batch(heads.sides[1]), f = with_batch(heads.sides[2]);
  std::vector<RawDetection> found;
  decode_nanodet(views(a, b, c, d, e, f), kSettings, kNanoDetMiddle, found);
  ASSERT_EQ(found.size(), 1u);
  expect_box(found[0], 23.5f, 23.5f, 71.5f, 31.5f);
}

TEST(DecodeNanoDet, RefusesWhatCannotBePaired) {
  const Heads heads;
  std::vector<RawDetection> found;
  DecodeSettings as_many_classes_as_bins = kSettings;
  as_many_classes_as_bins.class_count = 32;
  const MadeTensor twin({64, 32});
  EXPECT_THROW(decode_nanodet(views(heads.sides[0], twin), as_many_classes_as_bins, kNanoDetMiddle, found), Error);
  EXPECT_THROW(decode_nanodet(views(heads.scores[0], heads.scores[1]), kSettings, kNanoDetMiddle, found), Error);
}

TEST(DecodeNanoDet, ClassesMayBeAsManyAsBinsOfAnother) {
  // Twenty columns could be five bins a side; they are the classes of VOC.
  const DecodeSettings voc{{64, 64}, 20, 0.4f};
  Heads heads;
  MadeTensor scores8({64, 20}), scores16({16, 20}), scores32({4, 20});
  scores16.at({6, 14}) = 0.7f;
  std::vector<RawDetection> found;
  decode_nanodet(views(scores8, scores16, scores32, heads.sides[0], heads.sides[1], heads.sides[2]), voc,
                 kNanoDetMiddle, found);
  ASSERT_EQ(found.size(), 1u);
  expect_box(found[0], 23.5f, 23.5f, 71.5f, 31.5f);
  EXPECT_EQ(found[0].label, 14);
}

TEST(DecodeNanoDetPlus, ClassesFirstThenBinsMiddlesAtTheCorner) {
  MadeTensor output({1, 85, 3 + 32});
  // 64 + 6: stride 16, column 2, row 1, middle (32, 16).
  output.write({0, 70, 0}, {0.1f, 0.2f, 0.8f});
  output.at({0, 70, 3 + 1}) = output.at({0, 70, 3 + 8 + 1}) = output.at({0, 70, 3 + 16 + 1}) = kSure;
  output.at({0, 70, 3 + 24 + 3}) = kSure;
  std::vector<RawDetection> found;
  decode_nanodet_plus(output.view(), kSettings, found);
  ASSERT_EQ(found.size(), 1u);
  expect_box(found[0], 16, 0, 48, 64);
  EXPECT_EQ(found[0].label, 2);
  EXPECT_THROW(decode_nanodet_plus(MadeTensor({1, 86, 35}).view(), kSettings, found), Error);
  EXPECT_THROW(decode_nanodet_plus(MadeTensor({1, 85, 36}).view(), kSettings, found), Error);
}

TEST(DecodeNanoDetPlus, NanDistancesAreNoBox) {
  MadeTensor output({1, 85, 35});
  output.write({0, 0, 0}, {0.9f, 0, 0, NAN});
  std::vector<RawDetection> found;
  decode_nanodet_plus(output.view(), kSettings, found);
  EXPECT_TRUE(found.empty());
}

}  // namespace
}  // namespace stillpoint::decode_nanodet_test
