// SPDX-FileCopyrightText: 2026 The stillpoint authors
// SPDX-License-Identifier: MIT

// Each source of frames that is not a TUM folder, from outside: that it runs, what it says, what is wrong with it.

#include <gtest/gtest.h>

#include <cstddef>
#include <cstdlib>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <opencv2/imgcodecs.hpp>
#include <opencv2/videoio.hpp>
#include <string>
#include <vector>

#include "run_program.hpp"
#include "small_euroc.hpp"
#include "small_sequence.hpp"

namespace system_test {
namespace {

using Json = nlohmann::json;

class Inputs : public testing::Test {
 protected:
  Outcome run(const std::string& arguments) const {
    return run_program("--quiet --out " + quoted(out) + ' ' + arguments);
  }
  void expect_run(const std::string& arguments) {
    const Outcome outcome = run(arguments);
    EXPECT_EQ(outcome.status, 0) << arguments << '\n' << outcome.error;
    EXPECT_TRUE(outcome.error.empty()) << outcome.error;
    EXPECT_EQ(files_in(out).size(), 8u);
    said = outcome.out;
  }
  void expect_named_error(const std::string& arguments, const std::vector<std::string>& texts) const {
    expect_error("--quiet --out " + quoted(out) + ' ' + arguments, texts);
    EXPECT_EQ(files_in(out), std::vector<std::string>()) << "half-written files";
  }
  bool says(const std::string& text) const { return said.find(text) != std::string::npos; }
  Json report() const { return Json::parse(read_text(out / "report.json")); }
  std::string page() const { return read_text(out / "report.html"); }

  /// Writes the left and right images of a rectified pair, 160 × 120 pixels, and a camera for them.
  void write_pair(int frame_count, const std::string& baseline = "baseline_m: 0.11\n") {
    stillpoint::synthetic::SceneOptions options;
    options.frames = frame_count;
    options.width = 160;
    options.height = 120;
    const stillpoint::synthetic::Scene scene = stillpoint::synthetic::demo(options);
    stillpoint::SyntheticSequence left_sequence(scene), right_sequence(stillpoint::synthetic::right_of(scene, 0.11));
    stillpoint::SyntheticFrame frame;
    fs::create_directories(left);
    fs::create_directories(right);
    for (int i = 0; i < frame_count; ++i) {
      const std::string name = std::to_string(i) + ".png";
      left_sequence.render(i, frame);
      cv::imwrite((left / name).string(), stillpoint::as_mat(frame.colour.view()));
      right_sequence.render(i, frame);
      cv::imwrite((right / name).string(), stillpoint::as_mat(frame.colour.view()));
    }
    write_text(folder / "pair.yaml",
               "%YAML:1.0\n---\nfx: 131.25\nfy: 131.25\ncx: 79.5\ncy: 59.5\nwidth: 160\nheight: 120\n" + baseline);
  }
  std::string pair_arguments() const {
    return "--images " + quoted(left) + " --right " + quoted(right) + " --camera " + quoted(folder / "pair.yaml");
  }

  void write_video(int frame_count) {
    write_pair(1);
    cv::VideoWriter writer(video.string(), cv::CAP_OPENCV_MJPEG, cv::VideoWriter::fourcc('M', 'J', 'P', 'G'), 10.0,
                           {160, 120});
    const cv::Mat image = cv::imread((left / "0.png").string());
    for (int i = 0; i < frame_count; ++i) writer.write(image);
  }

  TemporaryFolder folder;
  const fs::path out = folder / "out", euroc = folder / "euroc", left = folder / "left", right = folder / "right",
                 video = folder / "video.avi";
  std::string said;
};

TEST_F(Inputs, EurocFolderIsARunWithDepthAndGroundTruth) {
  stillpoint::synthetic::SceneOptions options;
  options.frames = 5;
  options.width = 320;
  options.height = 240;
  write_euroc_sequence(euroc, stillpoint::synthetic::static_room(options));
  expect_run("--euroc " + quoted(euroc));
  const Json found = report();
  EXPECT_EQ(found["sequence"], "euroc");
  EXPECT_EQ(found["frames"], 5);
  EXPECT_EQ(found["statuses"], (Json{{"first_frame", 1}, {"ok", 4}})) << found["statuses"];
  EXPECT_TRUE(found["assumptions"].empty());
  EXPECT_FALSE(found["interrupted"]);
  ASSERT_TRUE(found["ate_rmse_m"].is_number());
  EXPECT_LT(found["ate_rmse_m"], 0.005) << "of a camera that went three centimetres";
  EXPECT_TRUE(found["labels"]["recall"].is_null());
  EXPECT_NE(page().find("<td>stereo</td>"), std::string::npos) << "the depth's noise is that of the pair";
}

TEST_F(Inputs, EurocFolderWithoutGroundTruthSaysSo) {
  write_small_euroc_sequence(euroc, 3);
  fs::remove_all(euroc / "mav0" / "state_groundtruth_estimate0");
  expect_run("--euroc " + quoted(euroc / "mav0"));
  EXPECT_TRUE(says("There is no reference")) << said;
  EXPECT_TRUE(report()["ate_rmse_m"].is_null());
  EXPECT_EQ(report()["frames_without_pose"], 0);
}

TEST_F(Inputs, EurocFolderThatIsBroken) {
  write_small_euroc_sequence(euroc, 3);
  const std::string name = "1403636579796888917.png";  // the second of them
  const fs::path image = euroc / "mav0" / "cam1" / "data" / name;
  ASSERT_TRUE(fs::exists(image));
  write_text(image, "this is no image");
  expect_named_error("--euroc " + quoted(euroc), {name, "cannot be read"});
  cv::imwrite(image.string(), cv::Mat(60, 80, CV_8UC1, cv::Scalar(0)));
  expect_named_error("--euroc " + quoted(euroc), {name, "found 80 x 60 pixels, expected the camera's 160 x 120"});
  fs::remove(image);
  expect_named_error("--euroc " + quoted(euroc), {"cam1/data.csv:3", name, "expected an image that is there"});
  expect_named_error("--euroc " + quoted(folder / "nowhere"), {"nowhere", "expected the folder of a EuRoC sequence"});
}

TEST_F(Inputs, StereoDepthOfATumFolderHasTheBaselineOfItsCameraFile) {
  const fs::path tum = folder / "tum";
  write_small_sequence(tum, 2);
  expect_run("--depth-noise stereo --tum " + quoted(tum));
  EXPECT_TRUE(says("The depth's baseline is not known: 0.10 m is assumed")) << said;
  write_text(tum / "camera.yaml", read_text(tum / "camera.yaml") + "baseline_m: 0.055\n");
  expect_run("--depth-noise stereo --tum " + quoted(tum));
  EXPECT_TRUE(report()["assumptions"].empty());
}

TEST_F(Inputs, RectifiedPairIsARunWithDepth) {
  write_pair(4);
  expect_run(pair_arguments() + " --fps 30");
  EXPECT_EQ(report()["statuses"], (Json{{"first_frame", 1}, {"ok", 3}}));
  EXPECT_EQ(report()["sequence"], "left");
  EXPECT_TRUE(report()["assumptions"].empty());
  EXPECT_EQ(report()["frames_without_pose"], 0);
}

// At half a metre the disparity would be 131.25 x 1.0 / 0.5 = 262.5 px, in an image of 160. Counted in steps of 16 px,
// 144 are less than 160: 131.25 / 144 = 0.911 m.
TEST_F(Inputs, RectifiedPairThatIsFarApartSeesNothingNear) {
  write_pair(2, "baseline_m: 1.0\n");
  expect_run(pair_arguments() + " --fps 30");
  EXPECT_TRUE(says("Nothing is nearer than 0.91 m: at that depth the disparity is as wide as the image.")) << said;
  EXPECT_EQ(report()["assumptions"].size(), 1u);
}

TEST_F(Inputs, CameraOfAFolderOfImagesMayLieInIt) {
  write_pair(2);
  fs::rename(folder / "pair.yaml", left / "camera.yaml");
  expect_run("--images " + quoted(left) + " --right " + quoted(right) + " --fps 30");
  expect_run("--images " + quoted(left) + " --fps 30");
  EXPECT_TRUE(report()["assumptions"].empty());
}

TEST_F(Inputs, RectifiedPairThatIsNone) {
  write_pair(3);
  expect_named_error("--images " + quoted(left) + " --right " + quoted(right),
                     {"--right: found no camera", "expected --camera FILE", "baseline_m"});
  fs::remove(right / "1.png");
  expect_named_error(pair_arguments(), {"1.png", "found no image of this name in the folder of the right camera"});
  cv::imwrite((right / "1.png").string(), cv::Mat(60, 80, CV_8UC1, cv::Scalar(0)));
  expect_named_error(pair_arguments(), {"1.png", "found 80 x 60 pixels, expected the camera's 160 x 120"});
  write_pair(3, "");
  expect_named_error(pair_arguments(), {"pair.yaml", "baseline_m is missing", "in metres"});
  write_pair(3, "baseline_m: 0.11\np1: 0.1\np2: 0\nk1: 0.1\nk2: 0\n");
  expect_named_error(pair_arguments(), {"pair.yaml", "found lens distortion", "--right takes rectified images"});
}

TEST_F(Inputs, ImagesAloneRunOnAGuessedCameraAndSaySo) {
  write_pair(11);
  expect_run("--images " + quoted(left));
  EXPECT_TRUE(says("a horizontal field of view of 60 degrees is assumed (--camera)")) << said;
  EXPECT_TRUE(says("30 frames per second are assumed (--fps)")) << said;
  EXPECT_TRUE(says("Without depth nothing is in metres")) << said;
  EXPECT_EQ(report()["policies"], "monocular");
  EXPECT_NE(page().find("field of view of 60 degrees"), std::string::npos);
  const Json found = report();
  EXPECT_EQ(found["assumptions"].size(), 2u);
  EXPECT_EQ(found["frames"], 11);
  EXPECT_FALSE(found["statuses"].contains("no_depth"));
  EXPECT_TRUE(found["frames_without_pose"].is_null()) << "a tracker that takes depth did not run";
  const auto rows = read_csv(out / "frames.csv");
  EXPECT_EQ(rows.at(2).at(0), "0.03333333333333333") << "1.png";
  EXPECT_EQ(rows.at(11).at(0), "0.3333333333333333") << "10.png comes last, not second";
}

TEST_F(Inputs, PoliciesThatNeedDepthKeepEverythingAndSaySo) {
  write_pair(4);
  expect_run("--images " + quoted(left) + " --policies default");
  EXPECT_TRUE(says("they have no depth, which --policies default needs")) << said;
  EXPECT_EQ(report()["kept_share"], 1.0) << "what can't be judged is kept";
  EXPECT_FALSE(report()["statuses"].contains("ok"));
}

TEST_F(Inputs, MonocularPoliciesHaveNoDepthToChoose) {
  write_pair(4);
  expect_named_error("--images " + quoted(left) + " --depth-noise tof",
                     {"--depth-noise: found with --policies monocular"});
  expect_named_error("--images " + quoted(left) + " --without memory", {"--without: found with --policies monocular"});
}

TEST_F(Inputs, ImagesWithACameraAreNotGuessed) {
  write_pair(2);
  expect_run("--images " + quoted(left) + " --camera " + quoted(folder / "pair.yaml") + " --fps 20");
  EXPECT_TRUE(report()["assumptions"].empty());
  EXPECT_EQ(read_csv(out / "frames.csv").at(2).at(0), "0.050000");
}

TEST_F(Inputs, ImagesThatAreNone) {
  fs::create_directories(left);
  expect_named_error("--images " + quoted(left), {"left", "found no image", "expected files named .png"});
  expect_named_error("--images " + quoted(folder / "nowhere"), {"nowhere", "no such folder"});
  write_pair(2);
  cv::imwrite((left / "1.png").string(), cv::Mat(60, 80, CV_8UC1, cv::Scalar(0)));
  expect_named_error("--images " + quoted(left), {"1.png", "found 80 x 60 pixels, expected the camera's 160 x 120"});
  write_pair(2);
  fs::remove(left / "1.png");
  cv::imwrite((left / "0.png").string(), cv::Mat(60, 80, CV_8UC1, cv::Scalar(0)));
  expect_named_error("--images " + quoted(left) + " --camera " + quoted(folder / "pair.yaml"),
                     {"pair.yaml", "found a camera of 160 x 120 pixels, expected that of the images, 80 x 60"});
}

TEST_F(Inputs, VideoRunsToItsEnd) {
  write_video(40);
  expect_run("--video " + quoted(video));
  EXPECT_EQ(report()["frames"], 40);
  EXPECT_EQ(report()["sequence"], "video.avi");
  EXPECT_EQ(report()["assumptions"].size(), 1u);
  EXPECT_EQ(read_csv(out / "frames.csv").at(3).at(0), "0.200000");
  // How many there will be is not known; each has its picture while they fit.
  std::size_t pictures = 0;
  const std::string html = page(), head = "\"jpeg\":\"data:image/jpeg;base64,";
  for (std::size_t at = html.find(head); at != std::string::npos; at = html.find(head, at + 1)) ++pictures;
  EXPECT_EQ(pictures, 40u);
}

TEST_F(Inputs, VideoCanBeCutShort) {
  write_video(6);
  expect_run("--video " + quoted(video) + " --start 4 --frames 1");
  EXPECT_EQ(read_csv(out / "frames.csv").at(1).at(0), "0.400000");
  EXPECT_EQ(report()["frames"], 1);
  fs::remove_all(out);
  expect_named_error("--video " + quoted(video) + " --start 6",
                     {"--start: found 6", "expected less than the number of frames of video.avi"});
}

TEST_F(Inputs, VideoThatBreaksOff) {
  write_video(40);
  fs::resize_file(video, fs::file_size(video) / 2);
  expect_named_error("--video " + quoted(video), {"video.avi", "breaks off", "expected a whole video"});
}

TEST_F(Inputs, VideoThatIsNone) {
  write_text(video, "this is no video");
  expect_named_error("--video " + quoted(video), {"video.avi", "cannot be read", "expected a video"});
  expect_named_error("--video " + quoted(folder / "none.avi"), {"none.avi", "no such file"});
  expect_named_error("--video 9731", {"camera 9731", "expected the number of a camera that is connected"});
}

// The signal comes as soon as there are output files, which is before the first frame is done.
TEST_F(Inputs, CtrlCAndAPoliteKillEndARunWithItsReport) {
  for (const std::string signal : {"INT", "TERM", "HUP"}) {
    fs::remove_all(out);
    const std::string program = std::string("\"") + STILLPOINT_RUN_PROGRAM + "\" --quiet --demo --out " + quoted(out);
    const std::string command = program + " > " + quoted(folder / "said") + " & run=$!; while kill -0 $run && [ ! -e " +
                                quoted(out / "features.csv.partial0") + " ]; do :; done; kill -" + signal +
                                " $run; wait $run";
    EXPECT_EQ(std::system(command.c_str()), 0) << signal;
    EXPECT_EQ(files_in(out).size(), 8u) << signal;
    EXPECT_TRUE(report()["interrupted"]);
    EXPECT_LT(report()["frames"], 60);
    EXPECT_GE(report()["frames"], 1);
    EXPECT_NE(read_text(folder / "said").find("The run was interrupted"), std::string::npos);
  }
}

TEST_F(Inputs, OneAtATime) {
  expect_named_error("--euroc a --video b", {"found --euroc and --video", "expected one of them"});
  expect_named_error("--tum a --images b", {"found --tum and --images", "expected one of them"});
  expect_named_error("--right a", {"--right: found without --images"});
  expect_named_error("--euroc a --camera b", {"--camera: found with --euroc", "expected it with --tum"});
  expect_named_error("--tum a --fps 10", {"--fps: found with --tum", "expected it with --images or --video"});
  expect_named_error("--video 0 --fps 10", {"--fps: found with a camera", "expected a video file"});
  expect_named_error("--images a --fps 0", {"--fps", "found '0'", "expected a number from"});
  expect_named_error("--video a --prior boxes", {"--prior: found boxes with --video a", "belongs to --tum"});
  write_pair(2);
  expect_named_error("--images " + quoted(left) + " --prior labels", {"--prior", "found labels", "left has none"});
}

}  // namespace
}  // namespace system_test
