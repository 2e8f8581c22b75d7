// SPDX-FileCopyrightText: 2026 The stillpoint authors
// SPDX-License-Identifier: MIT

// A host of ours with the members of ORB-SLAM3 that docs/hosts/orb_slam3*.diff names, for host_diff.sh: no code of
// ORB-SLAM3. C++11 for the shim, C++17 for the headers.

#include <opencv2/core/core.hpp>
#include <vector>
#if __cplusplus >= 201703L
#include <Eigen/Geometry>
#endif

//@ include/Tracking.h 1

namespace ORB_SLAM3 {

#if __cplusplus >= 201703L
using SE3f = Eigen::Isometry3f;
#else
struct Matrix4f {
  float operator()(int row, int column) const;
};
struct SE3f {
  Matrix4f matrix() const;
};
#endif

struct Frame {
  std::vector<cv::KeyPoint> mvKeys, mvKeysUn;
  std::vector<float> mvuRight, mvDepth;
  cv::Mat mDescriptors;
  std::vector<int*> mvpMapPoints;
  std::vector<bool> mvbOutlier;
  std::vector<std::size_t> mGrid[64][48];
  int N;
  SE3f GetPose() const;
};

class ORBextractor {
 public:
  void ComputeKeyPointsOctTree(int level, int minBorderX, std::vector<cv::KeyPoint>& vToDistributeKeys);

 protected:
  std::vector<float> mvScaleFactor;
  //@ include/ORBextractor.h 1
};

class Tracking {
 public:
  ~Tracking();
  enum eTrackingState { NO_IMAGES_YET, NOT_INITIALIZED, OK };
  void GrabImageRGBD(cv::Mat imDepth, const double& timestamp);
  void Track();
  void ChangeCalibration();

  eTrackingState mState;
  ORBextractor* mpORBextractorLeft;
  cv::Mat mImGray, mK, mDistCoef;
  Frame mCurrentFrame;
  //@ include/Tracking.h 2
};

}  // namespace ORB_SLAM3

//@ src/ORBextractor.cc 1
//@ src/Tracking.cc 1

namespace ORB_SLAM3 {

void ORBextractor::ComputeKeyPointsOctTree(int level, int minBorderX, std::vector<cv::KeyPoint>& vToDistributeKeys) {
  //@ src/ORBextractor.cc 2
}

Tracking::~Tracking() {}

void Tracking::GrabImageRGBD(cv::Mat imDepth, const double& timestamp) {
  //@ src/Tracking.cc 2
  mCurrentFrame = Frame();
  //@ src/Tracking.cc 3
  Track();
  //@ src/Tracking.cc 4
}

void Tracking::ChangeCalibration() {
  //@ src/Tracking.cc 5
}

}  // namespace ORB_SLAM3
