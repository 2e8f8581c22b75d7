// SPDX-FileCopyrightText: 2026 The stillpoint authors
// SPDX-License-Identifier: MIT

#include "stillpoint/evaluation/mover_score.hpp"

#include <gtest/gtest.h>

#include <cstdint>
#include <vector>

#include "compile_fail/sound_policies.hpp"

namespace stillpoint::mover_score_test {
namespace {

/// Says what it was told to say.
struct ScriptedMovers {
  struct Part {
    std::uint32_t id;
    std::vector<std::uint32_t> features;
  };
  std::vector<Part> parts;  ///< of the coming frame, by rising identifiers

  template <class AnyCamera>
  void track(const FrameView&, const Observations&, const Motion&, const AnyCamera&, span<Label>, Movers& movers,
             Workspace&) const {
    for (const Part& part : parts) {
      Mover mover;
      mover.id = part.id;
      mover.first_feature = movers.feature.size();
      mover.feature_count = part.features.size();
      movers.feature.insert(movers.feature.end(), part.features.begin(), part.features.end());
      movers.list.push_back(mover);
    }
  }
  void reset() const {}
};

struct Scripted : SoundPolicies {
  using Movers = ScriptedMovers;
};

/// Ten features: the first five lie on object 0, the next four on object 1, the last on neither.
class Script {
 public:
  Script() { show({}); }  // the first frame is left out

  void show(const std::vector<ScriptedMovers::Part>& parts) {
    filter_.movers.parts = parts;
    const std::vector<std::int32_t> object_of = {0, 0, 0, 0, 0, 1, 1, 1, 1, -1};
    const std::vector<Vector2f> keypoints(object_of.size(), Vector2f(5, 5));
    const std::vector<TrueObject> objects = {{Pose::Identity(), 20}, {Pose::Identity(), 20}};
    std::vector<std::uint8_t> pixels(100, 0);
    FrameView frame;
    frame.gray = ImageView(pixels.data(), 10, 10, 10, PixelFormat::gray8);
    frame.timestamp_s = time_s_;
    time_s_ += 0.1;
    const FrameResult& result = filter_.filter_frame(frame, keypoints);
    ASSERT_TRUE(judged(result.status()) || result.status() == Status::first_frame) << to_string(result.status());
    score_.add_frame(frame.timestamp_s, Pose::Identity(), objects, object_of, result);
  }
  MoverFigures figures(std::size_t object) const { return score_.figures(object); }

 private:
  FrameFilter<Scripted> filter_{Camera(10, 10, 5, 5, 10, 10)};
  MoverScore score_{2};
  double time_s_ = 1.0;
};

TEST(MoverScore, AMoverIsThatOfTheObjectOnWhichMostOfItsFeaturesLie) {
  Script script;
  script.show({{1, {0, 1, 5}}, {2, {5, 6, 0, 1}}});  // 2 of 3 on object 0; 2 of 4 on object 1 are not most
  EXPECT_EQ(script.figures(0).frames, 1u);
  EXPECT_EQ(script.figures(0).found, 1u);
  EXPECT_EQ(script.figures(1).frames, 1u);
  EXPECT_EQ(script.figures(1).found, 0u);
}

// A torso and its legs, say, which are two movers: it is the same two all the time.
TEST(MoverScore, ThePartThatIsLargerMayChange) {
  Script script;
  script.show({{1, {0, 1, 2}}, {2, {3, 4}}});
  script.show({{1, {0}}, {2, {1, 2, 3, 4}}});
  script.show({{1, {0, 1, 2}}, {2, {3, 4}}});
  EXPECT_EQ(script.figures(0).found, 3u);
  EXPECT_EQ(script.figures(0).switches, 0u);
}

TEST(MoverScore, CountsHowOftenAnotherMoverIsTheObject) {
  Script script;
  script.show({{1, {0, 1, 2}}, {2, {5, 6, 7}}});
  script.show({{1, {5, 6, 7}}, {2, {0, 1, 2}}});  // they are taken for each other
  EXPECT_EQ(script.figures(0).switches, 1u);
  EXPECT_EQ(script.figures(1).switches, 1u);
  script.show({{2, {0, 1, 2}}});  // nobody on object 1: not found, no switch
  script.show({{2, {0, 1, 2}}, {3, {5, 6}}});
  EXPECT_EQ(script.figures(0).switches, 1u);
  EXPECT_EQ(script.figures(1).switches, 2u);
  EXPECT_EQ(script.figures(1).found, 3u);
}

}  // namespace
}  // namespace stillpoint::mover_score_test
