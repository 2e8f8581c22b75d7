// SPDX-FileCopyrightText: 2026 The stillpoint authors
// SPDX-License-Identifier: MIT

// Every host's minimum, through the filter's keep-floor: what is left is enough for the host, or all there is.

#include <gtest/gtest.h>

#include <cstdint>
#include <vector>

#include "stillpoint/adapters/openvins.hpp"
#include "stillpoint/adapters/orb_slam.hpp"
#include "stillpoint/adapters/rtabmap.hpp"
#include "stillpoint/adapters/stella_vslam.hpp"
#include "stillpoint/verdict/keep_floor.hpp"

namespace {

struct HostFloor {
  const char* host;
  stillpoint::KeepFloor::Options options;
  std::size_t host_needs;  ///< what the host itself compares with; from its sources
};

class AdapterKeepFloor : public testing::TestWithParam<HostFloor> {
 protected:
  /// All features but `standing` judged dynamic. @return how many are kept in the end.
  static std::size_t kept_of(std::size_t count, std::size_t standing) {
    const std::vector<std::uint8_t> pixels_of_image(640 * 480);
    const stillpoint::ImageView image(pixels_of_image.data(), 640, 480, 640, stillpoint::PixelFormat::gray8);
    std::vector<stillpoint::Vector2f> pixels;
    std::vector<stillpoint::Label> labels(count);
    for (std::size_t i = 0; i < count; ++i) {
      pixels.emplace_back(static_cast<float>(i * 37 % 640), static_cast<float>(i * 91 % 480));
      labels[i].keep = i < standing;
      labels[i].log_odds = labels[i].keep ? -5.0f : 5.0f;
    }
    stillpoint::KeepFloor floor;
    floor.options = GetParam().options;
    stillpoint::Workspace workspace;
    floor.apply(pixels, image, labels, workspace);
    std::size_t kept = 0;
    for (const stillpoint::Label& label : labels) kept += label.keep;
    return kept;
  }
};

TEST_P(AdapterKeepFloor, LeavesWhatTheHostNeeds) {
  EXPECT_GE(kept_of(1000, 0), GetParam().host_needs);
  EXPECT_EQ(kept_of(1000, 0), GetParam().options.fewest_features);
  EXPECT_EQ(kept_of(1000, 900), 900u) << "enough stands still: nothing that moves is kept";
}

TEST_P(AdapterKeepFloor, KeepsAllWhereThereIsNotEnough) {
  const std::size_t few = GetParam().host_needs - 1;
  EXPECT_EQ(kept_of(few, 0), few);
  EXPECT_EQ(kept_of(0, 0), 0u);
}

INSTANTIATE_TEST_SUITE_P(
    Hosts, AdapterKeepFloor,
    testing::Values(HostFloor{"orb_slam_start", stillpoint::orb_slam::keep_floor(false), 501},  // N > 500
                    HostFloor{"orb_slam", stillpoint::orb_slam::keep_floor(true), 50},
                    HostFloor{"stella_vslam_start", stillpoint::stella_vslam::keep_floor(false), 50},
                    HostFloor{"stella_vslam", stillpoint::stella_vslam::keep_floor(true), 20},
                    HostFloor{"rtabmap", stillpoint::rtabmap::keep_floor(), 20},
                    HostFloor{"openvins", stillpoint::openvins::keep_floor(), 10}),
    [](const testing::TestParamInfo<HostFloor>& floor) { return floor.param.host; });

}  // namespace
