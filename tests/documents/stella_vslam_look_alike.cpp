// SPDX-FileCopyrightText: 2026 The stillpoint authors
// SPDX-License-Identifier: MIT

// A host of ours with the members of stella_vslam that docs/hosts/stella_vslam.diff names, for host_diff.sh: no code of
// stella_vslam.

#include <Eigen/Core>
#include <memory>
#include <opencv2/core.hpp>
#include <vector>
//@ src/stella_vslam/system.h 1
//@ src/stella_vslam/system.cc 1

namespace stella_vslam {

namespace camera {
struct base {
  virtual ~base() = default;
  unsigned int cols_, rows_;
};
struct perspective final : base {
  double fx_, fy_, cx_, cy_, k1_, k2_, p1_, p2_, k3_;
};
}  // namespace camera

enum class tracker_state_t { Initializing, Tracking, Lost };

struct tracking_module {
  tracker_state_t tracking_state_;
};

struct frame_observation {
  cv::Mat descriptors_;
};

class system {
 public:
  system();
  ~system();
  frame_observation create_RGBD_frame(const cv::Mat& img_gray, const cv::Mat& img_depth, const double timestamp);
  void feed_frame(const std::shared_ptr<Eigen::Matrix4d>& cam_pose_wc);

 private:
  camera::base* camera_ = nullptr;
  tracking_module* tracker_ = nullptr;
  std::vector<cv::KeyPoint> keypts_;
  //@ src/stella_vslam/system.h 2
};

system::system() {
  //@ src/stella_vslam/system.cc 2
}

system::~system() {}

frame_observation system::create_RGBD_frame(const cv::Mat& img_gray, const cv::Mat& img_depth, const double timestamp) {
  frame_observation frm_obs;
  //@ src/stella_vslam/system.cc 3
  return frm_obs;
}

void system::feed_frame(const std::shared_ptr<Eigen::Matrix4d>& cam_pose_wc) {
  if (tracker_->tracking_state_ == tracker_state_t::Tracking && cam_pose_wc) {
    //@ src/stella_vslam/system.cc 4
  }
}

}  // namespace stella_vslam
