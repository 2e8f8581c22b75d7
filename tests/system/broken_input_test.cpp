// SPDX-FileCopyrightText: 2026 The stillpoint authors
// SPDX-License-Identifier: MIT

// Folders with something wrong in them: a named error, and nothing half-written.

#include <gtest/gtest.h>

#include <algorithm>
#include <fstream>
#include <string>
#include <vector>

#include "run_program.hpp"
#include "small_sequence.hpp"

namespace system_test {
namespace {

/// A sound folder for each test to break. It is small: a run takes a fraction of a second.
class BrokenInput : public testing::Test {
 protected:
  void SetUp() override { write_small_sequence(sequence); }

  std::string arguments(const std::string& more = "") const {
    return "--quiet --tum " + quoted(sequence) + " --out " + quoted(out) + ' ' + more;
  }

  void expect_named_error(const std::vector<std::string>& texts, const std::string& more = "") const {
    expect_error(arguments(more), texts);
    EXPECT_EQ(files_in(out), std::vector<std::string>()) << "half-written files";
  }

  std::string line(int index) const {
    return split(read_text(sequence / "associations.txt"), '\n')[static_cast<std::size_t>(index)] + '\n';
  }

  TemporaryFolder folder;
  const fs::path sequence = folder / "sequence", out = folder / "out";
};

TEST_F(BrokenInput, SoundFolderRuns) {
  const Outcome outcome = run_program(arguments("--prior boxes"));
  EXPECT_EQ(outcome.status, 0) << outcome.error;
  EXPECT_EQ(files_in(out).size(), 8u);
}

TEST_F(BrokenInput, MissingFolder) {
  expect_error("--tum " + quoted(folder / "nowhere"), {"nowhere", "no such folder", "expected the folder of"});
}

TEST_F(BrokenInput, FolderThatIsAFile) {
  expect_error("--tum " + quoted(sequence / "camera.yaml"), {"camera.yaml", "not a folder"});
}

TEST_F(BrokenInput, NoCamera) {
  fs::rename(sequence / "camera.yaml", folder / "camera.yaml");
  expect_named_error({"found no camera", "expected camera.yaml"});
  const Outcome outcome = run_program(arguments("--camera " + quoted(folder / "camera.yaml")));
  EXPECT_EQ(outcome.status, 0) << outcome.error;
}

TEST_F(BrokenInput, CameraFileThatIsMissing) {
  expect_named_error({"nothing.yaml", "no such file"}, "--camera nothing.yaml");
}

TEST_F(BrokenInput, UnreadableImageInTheMiddleOfTheRun) {
  const std::string image = split(line(2), ' ')[1];
  write_text(sequence / image, "this is no image");
  expect_named_error({image, "cannot be read"});
}

TEST_F(BrokenInput, UnreadableDepthLeavesOlderResultsAlone) {
  ASSERT_EQ(run_program(arguments()).status, 0);
  const std::string before = read_text(out / "features.csv");
  const std::string image = split(split(line(3), '\n')[0], ' ')[3];
  write_text(sequence / image, "");
  expect_error(arguments("--features 50"), {image, "cannot be read"});
  EXPECT_EQ(read_text(out / "features.csv"), before);
  EXPECT_EQ(files_in(out).size(), 8u);
}

TEST_F(BrokenInput, AssociationsThatNameAMissingFile) {
  write_text(sequence / "associations.txt", line(0) + "1.5 rgb/none.png 1.5 depth/none.png\n");
  expect_named_error({"associations.txt:2", "rgb/none.png", "expected an image that is there"});
}

TEST_F(BrokenInput, FewMissingImagesAreLeftOutAndSaid) {
  std::string associations;
  for (int i = 0; i < 30; ++i)
    associations += std::to_string(1.0 + i / 30.0) + (i == 7 ? " rgb/gone.png " : " rgb/1.000000.png ") +
                    std::to_string(1.0 + i / 30.0) + " depth/1.000000.png\n";
  write_text(sequence / "associations.txt", associations);
  fs::remove_all(sequence / "labels");
  const Outcome outcome = run_program(arguments("--backend none --features 20"));
  ASSERT_EQ(outcome.status, 0) << outcome.error;
  EXPECT_NE(outcome.out.find("1 image that the sequence's lists name is missing: the frames were left out."),
            std::string::npos)
      << outcome.out;
  EXPECT_EQ(read_csv(out / "frames.csv").size(), 30u);  // the header's row and 29
  EXPECT_NE(read_text(out / "report.json").find("\"missing_files\": 1,"), std::string::npos);
}

TEST_F(BrokenInput, ImagesWithoutDepthAreLeftOutAndSaid) {
  fs::remove(sequence / "associations.txt");
  fs::remove_all(sequence / "labels");
  write_text(sequence / "rgb.txt", "1.0 rgb/1.000000.png\n1.1 rgb/1.000000.png\n1.2 rgb/1.000000.png\n");
  write_text(sequence / "depth.txt", "1.0 depth/1.000000.png\n1.15 depth/1.000000.png\n");
  const Outcome outcome = run_program(arguments("--backend none --features 20"));
  ASSERT_EQ(outcome.status, 0) << outcome.error;
  EXPECT_NE(outcome.out.find("2 images have no depth of their time and were left out."), std::string::npos)
      << outcome.out;
  EXPECT_NE(read_text(out / "report.json").find("\"images_without_depth\": 2,"), std::string::npos);
}

TEST_F(BrokenInput, AReferenceOfAnotherClockIsSaid) {
  write_text(sequence / "groundtruth.txt", "100.0 0 0 0 0 0 0 1\n100.1 1 0 0 0 0 0 1\n100.2 0 1 0 0 0 0 1\n");
  const Outcome outcome = run_program(arguments());
  ASSERT_EQ(outcome.status, 0) << outcome.error;
  EXPECT_NE(
      outcome.out.find("Fewer than three poses of the reference are within 10 ms of the trajectory's (is its clock "
                       "another one?), so the error of the trajectory is not known"),
      std::string::npos)
      << outcome.out;
  const std::string page = read_text(out / "report.html");
  EXPECT_EQ(page.find("There is no reference"), std::string::npos);
  EXPECT_EQ(page.find("there is no reference"), std::string::npos);
  EXPECT_NE(page.find("Difference of filtered and unfiltered"), std::string::npos) << "the plot";
}

TEST_F(BrokenInput, PipesAndDevicesAsTextFiles) {
  fs::remove(sequence / "associations.txt");
  ASSERT_EQ(std::system(("mkfifo " + quoted(sequence / "associations.txt")).c_str()), 0);
  expect_named_error({"associations.txt", "found a pipe or a device, expected a file"});
  expect_named_error({"/dev/zero", "expected a file"}, "--camera /dev/zero");
}

TEST_F(BrokenInput, StandardOutputThatIsFull) {
  if (!fs::exists("/dev/full")) GTEST_SKIP() << "no /dev/full here";
  const std::string program = std::string("\"") + STILLPOINT_RUN_PROGRAM + "\" ", error = quoted(folder / "error");
  for (const std::string& more : {arguments(), std::string("--help")}) {
    const int code = std::system((program + more + " > /dev/full 2> " + error).c_str());
    EXPECT_EQ(WEXITSTATUS(code), 2) << more;
    EXPECT_EQ(read_text(folder / "error").find("stillpoint_run: standard output: cannot write"), 0u) << more;
  }
}

TEST_F(BrokenInput, PathsWithOddCharactersAreNamedInOneLine) {
  expect_error("--tum \"$(printf '/no\\nwhere?')\"", {"/no?where?: no such folder"});
  const fs::path odd = folder / "odd\n?100%d";
  fs::rename(sequence, odd);
  const Outcome outcome = run_program("--quiet --backend none --tum " + quoted(odd) + " --out " + quoted(odd / "out?"));
  EXPECT_EQ(outcome.status, 0) << outcome.error;
  EXPECT_EQ(files_in(odd / "out?").size(), 8u);
}

TEST_F(BrokenInput, FrameTimeTwice) {
  write_text(sequence / "associations.txt", line(0) + line(1) + line(1) + line(2));
  expect_named_error({"associations.txt:3", "timestamp", "expected later than"});
}

TEST_F(BrokenInput, TimeThatRunsBackwards) {
  write_text(sequence / "associations.txt", line(0) + line(2) + line(1));
  expect_named_error({"associations.txt:3", "timestamp", "expected later than"});
}

TEST_F(BrokenInput, GroundTruthWithGarbage) {
  std::ofstream(sequence / "groundtruth.txt", std::ios::app) << "2.0 a b c d e f g\n";
  expect_named_error({"groundtruth.txt:", "'a'", "expected a finite number"});
}

TEST_F(BrokenInput, BoxesWithNaN) {
  write_text(sequence / "boxes.txt", "1.000000 person 0.9 nan 10 20 30\n");
  expect_named_error({"boxes.txt:1", "x 'nan'", "expected a finite number"}, "--prior boxes");
  EXPECT_EQ(run_program(arguments()).status, 0) << "who does not ask for the boxes does not read them";
}

TEST_F(BrokenInput, BoxesThatAreMissingOrNone) {
  write_text(sequence / "boxes.txt", "# nothing was detected\n");
  EXPECT_EQ(run_program(arguments("--prior boxes")).status, 0);
  fs::remove_all(out);
  fs::remove(sequence / "boxes.txt");
  expect_named_error({"boxes.txt", "no such file"}, "--prior boxes");
}

TEST_F(BrokenInput, LabelsThatAreMissing) {
  fs::remove_all(sequence / "labels");
  expect_named_error({"--prior", "found labels", "expected a folder with label images"}, "--prior labels");
  EXPECT_EQ(run_program(arguments()).status, 0);
}

TEST_F(BrokenInput, LabelsOfAnUnknownValue) {
  const std::string image = fs::path(split(line(1), ' ')[1]).filename().string();
  cv::imwrite((sequence / "labels" / image).string(), cv::Mat(120, 160, CV_8UC1, cv::Scalar(77)));
  expect_named_error({"labels of the frame at 1.033333", "label 77", "expected 0, 64, 128 or 255"});
}

TEST_F(BrokenInput, GapInTimeIsAStatus) {
  const std::string late = "9.0 " + split(line(3), ' ')[1] + " 9.0 " + split(line(3), ' ')[3];
  write_text(sequence / "associations.txt", line(0) + line(1) + late);
  ASSERT_EQ(run_program(arguments()).status, 0);
  EXPECT_EQ(read_csv(out / "frames.csv").at(3).at(1), "time_gap");
}

}  // namespace
}  // namespace system_test
