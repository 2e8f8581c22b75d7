// SPDX-FileCopyrightText: 2026 The stillpoint authors
// SPDX-License-Identifier: MIT

// Built twice: with all tests of the folder, and alone under ThreadSanitizer. Nothing here looks at a clock.

#include "stillpoint/detectors/async_detector.hpp"

#include <gtest/gtest.h>

#include <atomic>
#include <condition_variable>
#include <cstdint>
#include <memory>
#include <mutex>
#include <stdexcept>
#include <thread>
#include <vector>

namespace stillpoint {
namespace {

/// An image of 4 × 3 pixels of one value.
struct Picture {
  std::vector<std::uint8_t> pixels;

  explicit Picture(int value) : pixels(12, static_cast<std::uint8_t>(value)) {}
  ImageView view() const { return {pixels.data(), 4, 3, 4, PixelFormat::gray8}; }
};

constexpr int kThrows = 100, kThrowsNoException = 101, kThrowsNothingToSay = 102;

/// The number of pixels, at the place of the picture's value.
Detection detection_of(const ImageView& image) {
  return {{static_cast<float>(image.row<std::uint8_t>(image.height - 1)[image.width - 1]), 0,
           static_cast<float>(image.width), static_cast<float>(image.height)},
          Mobility::dynamic,
          0.5f};
}

/// Lets a test hold a detector under way, and tells it how far it is.
class Gate {
 public:
  explicit Gate(bool is_open) : is_open_(is_open) {}

  void pass(int value) {
    std::unique_lock lock(mutex_);
    seen_.push_back(value);
    changed_.notify_all();
    changed_.wait(lock, [this] { return is_open_; });
  }
  void open() {
    const std::lock_guard lock(mutex_);
    is_open_ = true;
    changed_.notify_all();
  }
  void wait_until_seen(std::size_t count) {
    std::unique_lock lock(mutex_);
    changed_.wait(lock, [&] { return seen_.size() >= count; });
  }
  std::vector<int> seen() {
    const std::lock_guard lock(mutex_);
    return seen_;
  }
  std::atomic<int> finished{0};

 private:
  std::mutex mutex_;
  std::condition_variable changed_;
  bool is_open_;
  std::vector<int> seen_;
};

struct FakeDetector {
  std::shared_ptr<Gate> gate;

  void detect(const ImageView& image, std::vector<Detection>& detections) {
    EXPECT_TRUE(detections.empty());
    const int value = image.row<std::uint8_t>(0)[0];
    gate->pass(value);
    detections.push_back(detection_of(image));
    if (value == kThrows) throw std::runtime_error("out of memory on the graphics card");
    if (value == kThrowsNoException) throw 7;
    if (value == kThrowsNothingToSay) throw std::runtime_error("");
    ++gate->finished;
  }
};
using Async = AsyncDetector<FakeDetector>;

struct Blind {};
static_assert(is_detector<FakeDetector>::value && !is_detector<Blind>::value);

std::shared_ptr<Gate> open_gate() { return std::make_shared<Gate>(true); }
std::shared_ptr<Gate> closed_gate() { return std::make_shared<Gate>(false); }

Async::Options synchronous(int detect_every = 1) {
  Async::Options options;
  options.is_synchronous = true;
  options.detect_every = detect_every;
  return options;
}

void expect_of(const DetectorAnswer& answer, int value, double timestamp_s) {
  EXPECT_EQ(answer.timestamp_s, timestamp_s);
  ASSERT_EQ(answer.detections.size(), 1u);
  EXPECT_EQ(answer.detections[0].box.x, static_cast<float>(value));
}

TEST(AsyncDetector, AnAnswerCarriesTheTimeOfItsFrame) {
  Async detector(FakeDetector{open_gate()});
  DetectorAnswer answer;
  EXPECT_FALSE(detector.take(answer)) << "nothing was offered";
  EXPECT_EQ(detector.status(), DetectorStatus::idle);
  for (const int value : {3, 5}) {
    EXPECT_TRUE(detector.offer(Picture(value).view(), 0.25 * value));
    detector.wait();
    ASSERT_TRUE(detector.take(answer));
    expect_of(answer, value, 0.25 * value);
    EXPECT_FALSE(detector.take(answer)) << "each answer once";
  }
  EXPECT_EQ(detector.status(), DetectorStatus::idle);
}

TEST(AsyncDetector, LooksAtTheNewestFrameAlone) {
  const auto gate = closed_gate();
  Async detector(FakeDetector{gate});
  detector.offer(Picture(1).view(), 1);
  gate->wait_until_seen(1);
  DetectorAnswer answer;
  for (const int value : {2, 3, 4}) {  // these calls would never return if they waited for the detector
    EXPECT_TRUE(detector.offer(Picture(value).view(), value));
    EXPECT_FALSE(detector.take(answer));
    EXPECT_EQ(detector.status(), DetectorStatus::working);
  }
  EXPECT_EQ(detector.counters().replaced, 2u);
  gate->open();
  detector.wait();
  EXPECT_EQ(gate->seen(), (std::vector<int>{1, 4}));
  ASSERT_TRUE(detector.take(answer));
  expect_of(answer, 4, 4);
  EXPECT_EQ(detector.counters().offered, 4u);
  EXPECT_EQ(detector.counters().detected, 2u);
}

TEST(AsyncDetector, AnAnswerThatNobodyTookGivesWayToTheNext) {
  Async detector(FakeDetector{open_gate()});
  for (const int value : {1, 2}) {
    detector.offer(Picture(value).view(), value);
    detector.wait();
  }
  DetectorAnswer answer;
  ASSERT_TRUE(detector.take(answer));
  expect_of(answer, 2, 2);
  EXPECT_FALSE(detector.take(answer));
}

TEST(AsyncDetector, TheImageNeedNotOutliveTheCall) {
  const auto gate = closed_gate();
  Async detector(FakeDetector{gate});
  detector.offer(Picture(1).view(), 1);
  gate->wait_until_seen(1);
  {
    Picture picture(2);
    detector.offer(picture.view(), 2);
    picture.pixels.assign(12, 9);
  }
  gate->open();
  detector.wait();
  DetectorAnswer answer;
  ASSERT_TRUE(detector.take(answer));
  expect_of(answer, 2, 2);
}

TEST(AsyncDetector, WhatTheDetectorThrowsIsAStatusAndItGoesOn) {
  for (const bool is_synchronous : {false, true}) {
    Async::Options options;
    options.is_synchronous = is_synchronous;
    Async detector(FakeDetector{open_gate()}, options);
    DetectorAnswer answer;
    const auto run = [&](int value) {
      detector.offer(Picture(value).view(), value);
      detector.wait();
    };
    run(kThrows);
    EXPECT_EQ(detector.status(), DetectorStatus::failed);
    EXPECT_EQ(detector.error(), "out of memory on the graphics card");
    EXPECT_FALSE(detector.take(answer)) << "what was found before it threw is no answer";
    run(kThrowsNoException);
    EXPECT_EQ(detector.error(), "an exception that is no std::exception");
    run(kThrowsNothingToSay);
    EXPECT_EQ(detector.status(), DetectorStatus::failed);
    EXPECT_EQ(detector.error(), "an exception without a message");
    run(5);
    EXPECT_EQ(detector.status(), DetectorStatus::idle);
    EXPECT_EQ(detector.error(), "");
    ASSERT_TRUE(detector.take(answer));
    expect_of(answer, 5, 5);
    EXPECT_EQ(detector.counters().failed, 3u);
    EXPECT_EQ(detector.counters().detected, 1u);
  }
}

TEST(AsyncDetector, AnAnswerOutlivesAFailureAfterIt) {
  Async detector(FakeDetector{open_gate()}, synchronous());
  detector.offer(Picture(5).view(), 5);
  detector.offer(Picture(kThrows).view(), 6);
  DetectorAnswer answer;
  ASSERT_TRUE(detector.take(answer));
  expect_of(answer, 5, 5);
}

TEST(AsyncDetector, DestructionWaitsForADetectionThatIsUnderWay) {
  const auto gate = closed_gate();
  auto detector = std::make_unique<Async>(FakeDetector{gate});
  detector->offer(Picture(1).view(), 1);
  gate->wait_until_seen(1);
  std::thread destroyer([&] { detector.reset(); });
  gate->open();
  destroyer.join();
  EXPECT_EQ(gate->finished, 1);
}

TEST(AsyncDetector, DestructionWithoutAnyFrame) { const Async detector(FakeDetector{closed_gate()}); }

TEST(AsyncDetector, TheSynchronousModeGivesWhatADirectCallGives) {
  const auto gate = open_gate();
  Async detector(FakeDetector{gate}, synchronous());
  for (int value = 0; value < 20; ++value) {
    const Picture picture(value);
    EXPECT_TRUE(detector.offer(picture.view(), 0.1 * value));
    EXPECT_EQ(gate->seen().size(), static_cast<std::size_t>(value) + 1) << "detected within the call";
    DetectorAnswer answer;
    ASSERT_TRUE(detector.take(answer));
    std::vector<Detection> direct;
    FakeDetector{open_gate()}.detect(picture.view(), direct);
    ASSERT_EQ(answer.detections.size(), direct.size());
    EXPECT_EQ(answer.detections[0].box.x, direct[0].box.x);
    EXPECT_EQ(answer.detections[0].confidence, direct[0].confidence);
    EXPECT_EQ(answer.timestamp_s, 0.1 * value);
  }
  EXPECT_EQ(detector.counters().detected, 20u);
}

TEST(AsyncDetector, LooksAtEveryNthFrameFromTheFirstOn) {
  for (const int every : {-1, 0, 1, 3}) {
    const auto gate = open_gate();
    Async detector(FakeDetector{gate}, synchronous(every));
    std::vector<int> expected;
    for (int value = 0; value < 10; ++value) {
      const bool is_wanted = every < 2 || value % every == 0;
      EXPECT_EQ(detector.offer(Picture(value).view(), value), is_wanted);
      if (is_wanted) expected.push_back(value);
    }
    EXPECT_EQ(gate->seen(), expected);
    EXPECT_EQ(detector.counters().skipped, 10 - expected.size());
  }
}

TEST(AsyncDetector, AnEmptyImageIsNoFrame) {
  for (const bool is_synchronous : {false, true}) {
    Async::Options options;
    options.is_synchronous = is_synchronous;
    Async detector(FakeDetector{open_gate()}, options);
    EXPECT_FALSE(detector.offer(ImageView(), 1));
    detector.wait();
    DetectorAnswer answer;
    EXPECT_FALSE(detector.take(answer));
    EXPECT_EQ(detector.counters().skipped, 1u);
  }
}

// For the sanitizer: a tracker at full speed, a detector at full speed, and somebody who watches.
TEST(AsyncDetector, NoFrameIsLostFromTheCounts) {
  Async detector(FakeDetector{open_gate()});
  std::atomic<bool> is_over{false};
  std::thread watcher([&] {
    while (!is_over) {
      const DetectorCounters counters = detector.counters();
      EXPECT_LE(counters.replaced + counters.detected + counters.failed, counters.offered);
      if (detector.status() == DetectorStatus::idle) detector.error();
      std::this_thread::yield();
    }
  });
  DetectorAnswer answer;
  double last_s = -1;
  constexpr int kFrames = 3000;
  for (int i = 0; i < kFrames; ++i) {
    detector.offer(Picture(i % 103).view(), i);
    if (i % 16 == 0) std::this_thread::yield();
    if (!detector.take(answer)) continue;
    EXPECT_GT(answer.timestamp_s, last_s);
    last_s = answer.timestamp_s;
    expect_of(answer, static_cast<int>(last_s) % 103, last_s);
  }
  detector.wait();
  is_over = true;
  watcher.join();
  const DetectorCounters counters = detector.counters();
  EXPECT_EQ(counters.offered, std::size_t{kFrames});
  EXPECT_EQ(counters.replaced + counters.detected + counters.failed, std::size_t{kFrames});
  EXPECT_GE(counters.detected, 1u);
}

}  // namespace
}  // namespace stillpoint
