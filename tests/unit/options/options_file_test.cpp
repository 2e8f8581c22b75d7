// SPDX-FileCopyrightText: 2026 The stillpoint authors
// SPDX-License-Identifier: MIT

#include "stillpoint/options/options_file.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <fstream>
#include <map>
#include <string>
#include <string_view>
#include <type_traits>
#include <utility>
#include <vector>

#include "stillpoint/policies.hpp"
#include "stillpoint/policies/with_movers.hpp"
#include "unit/error_of.hpp"
#include "unit/temporary_folder.hpp"

namespace stillpoint {
namespace {

Camera any_camera() { return {500, 500, 319.5, 239.5, 640, 480}; }

class OptionsFile : public testing::Test {
 protected:
  std::filesystem::path file(const std::string& text) const {
    return folder.write("options.yaml", "%YAML:1.0\n---\n" + text);
  }
  std::string error(const std::string& text) {
    return error_of([&] { read_options(file(text), filter); });
  }

  TemporaryFolder folder;
  FrameFilter<> filter{any_camera()};
};

/// Moves every number towards the end of its range that is farther away, turns flags and takes the next choice.
struct Change {
  template <class T>
  void operator()(const char*, T& value, const OptionRange& range) {
    const auto now = static_cast<double>(value);
    value = static_cast<T>(now + 0.3 * ((range.most - now > now - range.least ? range.most : range.least) - now));
  }
  template <class T>
  void operator()(const char*, T& value) {
    if constexpr (std::is_same_v<T, bool>)
      value = !value;
    else if constexpr (has_options<T, Change>::value)
      each_option(value, *this);
  }
  template <class T>
  void seed(const char*, T& value) {
    ++value;
  }
  template <class T, class... Words>
  void choice(const char*, T& value, Words...) {
    value = static_cast<T>((static_cast<std::size_t>(value) + 1) % sizeof...(Words));
  }
};

template <class Policies>
class OptionsOf : public testing::Test {};
using PolicySets =
    testing::Types<DefaultPolicies, PaperPolicies, PaperRigidPolicies, MonocularPolicies, WithMovers<DefaultPolicies>>;
TYPED_TEST_SUITE(OptionsOf, PolicySets);

TYPED_TEST(OptionsOf, EveryOptionSurvivesItsFile) {
  const TemporaryFolder folder;
  const std::filesystem::path path = folder.path() / "options.yaml";
  FrameFilter<TypeParam> original(any_camera()), restored(any_camera());
  const std::string defaults = options_as_yaml(original);
  Change change;
  each_option(original, change);
  const std::string changed = options_as_yaml(original);
  ASSERT_NE(changed, defaults);
  write_options(path, original);
  read_options(path, restored);
  EXPECT_EQ(options_as_yaml(restored), changed);
}

/// Converts to whatever a field is.
struct Anything {
  template <class T>
  operator T() const;
};
template <class Group, class Fields, class = void>
struct takes : std::false_type {};
template <class Group, std::size_t... I>
struct takes<Group, std::index_sequence<I...>, std::void_t<decltype(Group{(static_cast<void>(I), Anything{})...})>>
    : std::true_type {};
/// How many fields an aggregate has: the most that it can be initialised with.
template <class Group, std::size_t N = 40>
constexpr std::size_t field_count() {
  if constexpr (N == 0 || takes<Group, std::make_index_sequence<N>>::value)
    return N;
  else
    return field_count<Group, N - 1>();
}

/// Counts what is visited, groups as one.
struct Count : LooksAtOptions<Count> {
  std::size_t visited = 0;
  template <class T>
  void number(const char*, T&) {
    ++visited;
  }
  template <class T>
  void group(const char*, T&) {
    ++visited;
  }
  void word(const char*, const char*) { ++visited; }
};
template <class Group>
std::size_t visited(Group&& group) {
  Count count;
  each_option(group, count);
  return count.visited;
}

// A field that is added to a stage and forgotten in the file makes this fail.
TEST(StageOptions, NoFieldIsLeftOut) {
  EXPECT_EQ(visited(FrameCheck()), field_count<FrameCheck::Options>());
  EXPECT_EQ(visited(MaskPrediction()), field_count<MaskPrediction::Options>());
  EXPECT_EQ(visited(StereoNoise()), field_count<StereoNoise>());
  EXPECT_EQ(visited(TimeOfFlightNoise()), field_count<TimeOfFlightNoise>());
  EXPECT_EQ(visited(BoxPrior()), field_count<BoxPrior::Options>());
  EXPECT_EQ(visited(PropagatedPrior()), visited(BoxPrior()) + field_count<PropagatedPrior::Carrying>());
  EXPECT_EQ(visited(LucasKanade()), field_count<LucasKanade::Options>());
  EXPECT_EQ(visited(ProvidedMatches()), field_count<ProvidedMatches::Options>() + 3) << "older, places, surfaces";
  EXPECT_EQ(visited(OlderFrameChoice()), field_count<OlderFrameChoice>());
  EXPECT_EQ(visited(PlaceTest()), field_count<PlaceTest>() - 1) << "the guard is none";
  EXPECT_EQ(visited(CornerTracker()), field_count<CornerTracker::Options>());
  EXPECT_EQ(visited(PastReprojection()), field_count<PastReprojection::Options>() + 1) << "surfaces";
  EXPECT_EQ(visited(SurfaceSearch()), field_count<SurfaceSearch>() - 1) << "the guard is none";
  EXPECT_EQ(visited(EpipolarMotion()), field_count<EpipolarMotion::Options>());
  EXPECT_EQ(visited(RigidMotion()), field_count<RigidMotion::Options>());
  EXPECT_EQ(visited(SupportConstraints()), field_count<SupportConstraints>() - 2) << "surface weight, cells";
  EXPECT_EQ(visited(Inertia()), field_count<Inertia>());
  EXPECT_EQ(visited(SupportMotion()), field_count<SupportMotion::Options>() + 2) << "constraints, inertia";
  EXPECT_EQ(visited(OffsetScore()), field_count<OffsetScore::Options>());
  EXPECT_EQ(visited(SampsonScore()), field_count<SampsonScore::Options>());
  EXPECT_EQ(visited(ReprojectionScore()), field_count<ReprojectionScore::Options>());
  EXPECT_EQ(visited(MeanGate()), field_count<MeanGate::Options>());
  EXPECT_EQ(visited(TailGate()), field_count<TailGate::Options>());
  EXPECT_EQ(visited(RegionClusters()), field_count<RegionClusters::Options>());
  EXPECT_EQ(visited(FlowNeighbours()), field_count<FlowNeighbours::Options>());
  EXPECT_EQ(visited(SurfaceClusters()), field_count<SurfaceClusters::Options>());
  EXPECT_EQ(visited(EvidenceMemory()), field_count<EvidenceMemory::Options>());
  EXPECT_EQ(visited(KeepFloor()), field_count<KeepFloor::Options>());
  EXPECT_EQ(visited(MoverTracking()), field_count<MoverTracking::Options>());
}

TEST_F(OptionsFile, OptionsThatAreNotNamedStay) {
  const std::string before = options_as_yaml(filter);
  read_options(file("gate:\n   false_positive_rate: 0.05\n"), filter);
  EXPECT_EQ(filter.gate.options.false_positive_rate, 0.05);
  filter.gate.options.false_positive_rate = TailGate::Options{}.false_positive_rate;
  EXPECT_EQ(options_as_yaml(filter), before);
}

TEST_F(OptionsFile, DepthNoiseIsAModelAndItsParameters) {
  read_options(file("depth_noise:\n   model: stereo\n   baseline_m: 0.25\n   scale: 2.\n"), filter);
  const auto* const stereo = std::get_if<StereoNoise>(&filter.depth_noise.model);
  ASSERT_NE(stereo, nullptr);
  EXPECT_EQ(stereo->baseline_m, 0.25);
  EXPECT_EQ(stereo->focal_px, StereoNoise{}.focal_px);
  // z² σ_d / (f b) = 4 · 0.3 / (500 · 0.25) = 0.0096 m, twice.
  EXPECT_NEAR(filter.depth_noise.sigma(2.0), 0.0192, 1e-12);
}

TEST_F(OptionsFile, SeedsKeepTheirSixtyFourBits) {
  filter.ego_motion.options.seed = 0xfedc'ba98'7654'3210u;
  const std::filesystem::path path = folder.path() / "seed.yaml";
  write_options(path, filter);
  FrameFilter<> restored(any_camera());
  read_options(path, restored);
  EXPECT_EQ(restored.ego_motion.options.seed, 0xfedc'ba98'7654'3210u);
}

TEST_F(OptionsFile, ErrorsNameFileLineOptionFoundAndExpected) {
  const std::string name = (folder.path() / "options.yaml").string();
  EXPECT_EQ(error("gate:\n   rate: 0.1\n"), name + ":4: gate.rate is unknown, expected one of false_positive_rate");
  EXPECT_EQ(error("gait:\n   rate: 0.1\n").substr(0, name.size() + 50),
            name + ":3: gait is unknown, expected one of frame_check, ");
  EXPECT_EQ(error("gate: 3\n"), name + ":3: gate is no map, expected options as name: value, one a line and indented");
  EXPECT_EQ(error("gate:\n   false_positive_rate: high\n"),
            name + ":4: gate.false_positive_rate is 'high', expected a number from 0.000001 to 0.5");
  EXPECT_EQ(error("gate:\n   false_positive_rate: 0.\n"),
            name + ":4: gate.false_positive_rate is 0, expected a number from 0.000001 to 0.5");
  EXPECT_EQ(error("gate:\n   false_positive_rate: 5\n"),
            name + ":4: gate.false_positive_rate is 5, expected a number from 0.000001 to 0.5");
  EXPECT_EQ(error("scorer:\n   pixel_sigma: .Nan\n"),
            name + ":4: scorer.pixel_sigma is not finite, expected a number from 0.01 to 100");
  EXPECT_EQ(error("matcher:\n   corners:\n      cell_px: 1\n"),
            name + ":5: matcher.corners.cell_px is 1, expected a whole number from 8 to 512");
  EXPECT_EQ(error("matcher:\n   corners:\n      cell_px: 24.5\n"),
            name + ":5: matcher.corners.cell_px is 24.5, expected a whole number from 8 to 512");
  EXPECT_EQ(error("matcher:\n   corners:\n      cell_px: [24]\n"),
            name + ":5: matcher.corners.cell_px is no whole number, expected a whole number from 8 to 512");
  EXPECT_EQ(error("keep_floor:\n   fewest_features: 18446744073709551616\n"),
            name + ":4: keep_floor.fewest_features is 18446744073709551616, expected a whole number from 0 to 1000000");
  EXPECT_EQ(error("ego_motion:\n   seed: -1\n"),
            name + ":4: ego_motion.seed is -1, expected a whole number from 0 to 18446744073709551615");
  EXPECT_EQ(error("depth_noise:\n   model: sonar\n"),
            name + ":4: depth_noise.model is 'sonar', expected kinect or stereo or tof");
  EXPECT_EQ(error("depth_noise:\n   model: tof\n   baseline_m: 0.1\n"),
            name + ":5: depth_noise.baseline_m is unknown, expected one of model, constant_m, per_metre, scale");
  EXPECT_EQ(error("- gate\n"), name + ":3: is no map, expected fields as name: value");
  EXPECT_EQ(error("gate: " + std::string(40000, '[') + std::string(40000, ']')),
            name + ":3: nested more than 32 deep, expected fields as name: value");
}

TEST_F(OptionsFile, ThatOfASetWithMoversIsReadByOneWithout) {
  struct MoverPolicies : WithMovers<> {};
  FrameFilter<MoverPolicies> with_movers(any_camera());
  with_movers.gate.options.false_positive_rate = 0.2;
  const std::filesystem::path path = folder.path() / "movers.yaml";
  write_options(path, with_movers);
  read_options(path, filter);
  EXPECT_EQ(filter.gate.options.false_positive_rate, 0.2);
  with_movers.gate.options.false_positive_rate = 0.1;
  EXPECT_NE(
      error_of([&] { read_options(file("movers:\n   speed: 1\n"), with_movers); }).find("movers.speed is unknown"),
      std::string::npos)
      << "whose options they are checks them";
}

// What robots have: no first line of OpenCV's. A stage without an option is none.
TEST_F(OptionsFile, PlainYamlIsRead) {
  read_options(folder.write("options.yaml", "# mine\ngate:\nscorer: {pixel_sigma: 2, depth_sigmas: 3}\n"), filter);
  EXPECT_EQ(filter.scorer.options.pixel_sigma, 2.0);
  EXPECT_EQ(filter.scorer.options.depth_sigmas, 3.0);
  read_options(folder.write("options.yaml", ""), filter);
  FrameFilter<PaperPolicies> paper(any_camera());
  for (const char* flag : {"true", "1"}) {
    paper.scorer.options.printed_eq8 = false;
    read_options(folder.write("options.yaml", std::string("scorer:\n  printed_eq8: ") + flag + '\n'), paper);
    EXPECT_TRUE(paper.scorer.options.printed_eq8) << flag;
  }
  EXPECT_NE(error_of([&] {
              read_options(folder.write("options.yaml", "scorer:\n  printed_eq8: 2\n"), paper);
            }).find("scorer.printed_eq8 is no flag, expected true or false"),
            std::string::npos);
}

// As versions wrote it that had OpenCV for it: what is longer than 32 bits was text.
TEST_F(OptionsFile, WhatOpenCvWroteIsRead) {
  read_options(file("gate:\n   false_positive_rate: 5.0000000000000003e-02\nego_motion:\n   max_trials: 70\n"
                    "   seed: \"373949006231\"\n"),
               filter);
  EXPECT_EQ(filter.gate.options.false_positive_rate, 0.05);
  EXPECT_EQ(filter.ego_motion.options.max_trials, 70u);
  EXPECT_EQ(filter.ego_motion.options.seed, 373949006231u);
}

// ---- Options of earlier versions ----

/// YAML with one option, whose value is 1.
std::string yaml_of(std::string_view name) {
  std::string text;
  for (std::string indent;; indent += "   ") {
    const std::size_t dot = name.find('.');
    text += indent + std::string(name.substr(0, dot)) + (dot == std::string_view::npos ? ": 1\n" : ":\n");
    if (dot == std::string_view::npos) return text;
    name.remove_prefix(dot + 1);
  }
}

/// All names of a filter's options, with their stages.
struct Names : LooksAtOptions<Names> {
  std::vector<std::string> found;
  std::string path;
  std::map<std::string, std::string> text_of;
  template <class T>
  void number(const char* name, T& now) {
    if constexpr (!std::is_same_v<T, bool>) text_of[path + name] = option_text(now);
    found.push_back(path + name);
  }
  void word(const char* name, const char*) { found.push_back(path + name); }
  template <class T>
  void group(const char* name, T& value) {
    const std::string outer = path;
    path += std::string(name) + '.';
    each_option(value, *this);
    path = outer;
  }
};
template <class Policies>
Names all_options_of(FrameFilter<Policies>& filter) {
  Names names;
  each_option(filter, names);
  return names;
}
template <class Policies>
std::vector<std::string> names_of(FrameFilter<Policies>& filter) {
  return all_options_of(filter).found;
}

TEST_F(OptionsFile, ANameThatIsGoneIsRefusedWithWhatReplacedIt) {
  FrameFilter<MonocularPolicies> monocular(any_camera());
  const std::vector<std::string> names = names_of(filter);
  const std::vector<std::string> of_monocular = names_of(monocular);
  const std::string before = options_as_yaml(filter);
  for (const ReplacedOption& option : kReplacedOptions) {
    const std::string name(option.name), replacement(option.replacement);
    EXPECT_EQ(error(yaml_of(name)), (folder.path() / "options.yaml").string() +
                                        ": 1 option is gone; delete or rename\n  " + name + ": " + replacement);
    EXPECT_EQ(std::count(names.begin(), names.end(), name), 0) << name << " is not gone";
    if (replacement.rfind("fixed", 0) != 0) {
      EXPECT_TRUE(std::count(names.begin(), names.end(), replacement) == 1 ||
                  std::count(of_monocular.begin(), of_monocular.end(), replacement) == 1)
          << replacement << " is no option";
    }
  }
  EXPECT_EQ(options_as_yaml(filter), before);
}

TEST_F(OptionsFile, OfAnOldFileEachNameThatIsGoneIsListed) {
  const std::string found = error(
      "gate:\n   false_positive_rate: 0.05\n   decay: 0.8\nmemory:\n   persistence: 0.7\n   same_surface:\n"
      "      constant_m: 0.06\n      per_square_m: 0.0076\n");
  EXPECT_EQ(found.substr(found.find(": ")),
            ": 4 options are gone; delete or rename\n  gate.decay: fixed at 0.8: nats, measured with the whole filter\n"
            "  memory.persistence: memory.log_odds_decay_s\n"
            "  memory.same_surface.constant_m: fixed at 0.06: roughness of a surface\n"
            "  memory.same_surface.per_square_m: depth_noise.model");
  EXPECT_EQ(filter.gate.options.false_positive_rate, TailGate::Options{}.false_positive_rate);
  EXPECT_NE(error("memory:\n   same_surface:\n      constant_m: 1.\n      slope: 1.\n").find("same_surface is unknown"),
            std::string::npos)
      << "one that never was is no old option";
}

// What `write_options` left behind before options were fixed: every line of it is either read or listed.
TEST_F(OptionsFile, ACompleteFileOfBeforeIsRefusedLineByLine) {
  const Names options = all_options_of(filter);
  std::string text;
  std::vector<std::string> open;  // the groups of the line before
  std::vector<std::string> all(options.found);
  for (const ReplacedOption& option : kReplacedOptions) all.emplace_back(option.name);
  std::sort(all.begin(), all.end());
  for (const std::string& name : all) {
    if (name == "depth_noise.model") continue;  // not a number
    std::vector<std::string> groups;
    std::size_t begin = 0;
    for (std::size_t dot; (dot = name.find('.', begin)) != std::string::npos; begin = dot + 1)
      groups.push_back(name.substr(begin, dot - begin));
    std::size_t common = 0;
    while (common < std::min(groups.size(), open.size()) && groups[common] == open[common]) ++common;
    for (; common < groups.size(); ++common) text += std::string(3 * common, ' ') + groups[common] + ":\n";
    text += std::string(3 * groups.size(), ' ') + name.substr(begin) + ": " +
            (options.text_of.count(name) > 0 ? options.text_of.at(name) : "1") + '\n';
    open = groups;
  }
  const std::string found = error(text);
  EXPECT_EQ(static_cast<std::size_t>(std::count(found.begin(), found.end(), '\n')), kReplacedOptions.size()) << found;
  for (const ReplacedOption& option : kReplacedOptions)
    EXPECT_NE(found.find("\n  " + std::string(option.name) + ": "), std::string::npos) << option.name;
}

// A set whose stages still have them reads them: the paper's K-means has a seed, its matcher a border.
TEST_F(OptionsFile, WhatAnotherSetStillHasIsNotGoneThere) {
  FrameFilter<PaperPolicies> paper(any_camera());
  read_options(file("classifier:\n   seed: 7\n   max_iterations: 5\n"), paper);
  EXPECT_EQ(paper.classifier.options.seed, 7u);
}

// More than anyone can set by hand are none that users need (docs/tuning.md lists them).
TEST(StageOptions, DefaultPoliciesHaveFortyAtTheMost) {
  FrameFilter<> filter(any_camera());
  for (const AnyDepthNoise& noise :
       {AnyDepthNoise(KinectNoise{}), AnyDepthNoise(StereoNoise{}), AnyDepthNoise(TimeOfFlightNoise{})}) {
    filter.depth_noise = noise;
    EXPECT_LE(names_of(filter).size(), 40u) << "with depth noise " << noise.model.index();
    EXPECT_GE(names_of(filter).size(), 30u) << "the visitor sees groups as well";
  }
}

TEST_F(OptionsFile, NothingChangesWhereAnythingIsWrong) {
  const std::string before = options_as_yaml(filter);
  EXPECT_NE(error("scorer:\n   depth_sigmas: 2.\ndepth_noise:\n   model: tof\nmemory:\n   dynamic_prior_rise_s: -1.\n"),
            "");
  EXPECT_EQ(options_as_yaml(filter), before);
}

TEST_F(OptionsFile, FileThatIsNoneIsSaid) {
  EXPECT_EQ(error_of([&] { read_options(folder.path() / "none.yaml", filter); }),
            (folder.path() / "none.yaml").string() + ": no such file");
  const std::filesystem::path text = folder.path() / "text.yaml";
  std::ofstream(text) << "gate = 3\n";
  EXPECT_NE(error_of([&] { read_options(text, filter); }), "");
}

/// A stage of a user, with options of its own.
struct MyGate : TailGate {
  double patience_s = 1.0;
};
template <class Visit>
void each_option(MyGate& gate, Visit& visit) {
  visit("patience_s", gate.patience_s, OptionRange{0, 10});
}
struct MyPolicies : DefaultPolicies {
  using Gate = MyGate;
};

TEST_F(OptionsFile, StageOfAUserTakesPart) {
  FrameFilter<MyPolicies> mine(any_camera());
  read_options(file("gate:\n   patience_s: 3\n"), mine);
  EXPECT_EQ(mine.gate.patience_s, 3.0);
  EXPECT_EQ(mine.options_error(), "");
  mine.gate.patience_s = 11;
  EXPECT_EQ(mine.options_error(), "gate.patience_s is 11, expected a number from 0 to 10");
}

}  // namespace
}  // namespace stillpoint
