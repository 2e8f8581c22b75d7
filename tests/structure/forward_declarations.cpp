// SPDX-FileCopyrightText: 2026 The stillpoint authors
// SPDX-License-Identifier: MIT

// stillpoint/fwd.hpp declares what the other headers define: a host's header that includes it alone fits a host's
// source that includes all.

#include "stillpoint/fwd.hpp"

#if defined(EIGEN_WORLD_VERSION) || defined(CV_VERSION)
#error "stillpoint/fwd.hpp includes neither Eigen nor OpenCV"
#endif

namespace forward_declarations {

struct HostHeader {
  ~HostHeader();
  stillpoint::FrameFilter<>* filter;
  stillpoint::FrameFilter<stillpoint::MonocularPolicies>* monocular_filter;
  stillpoint::ImageBuffer* mask;
  const stillpoint::FrameResult& judge(const stillpoint::FrameView& frame, const stillpoint::Camera& camera);
};

}  // namespace forward_declarations

#include <type_traits>

#include "stillpoint/core.hpp"
#include "stillpoint/policies.hpp"
#include "stillpoint/stillpoint.hpp"

namespace forward_declarations {

HostHeader::~HostHeader() {
  delete filter;
  delete mask;
}

template <class... Types>
constexpr bool all_are_defined = ((sizeof(Types) > 0) && ...);

static_assert(
    all_are_defined<stillpoint::AnyDistortion, stillpoint::Camera, stillpoint::ImageView, stillpoint::ImageBuffer,
                    stillpoint::DepthView, stillpoint::FrameView, stillpoint::Detection, stillpoint::FrameResult,
                    stillpoint::DefaultPolicies, stillpoint::MonocularPolicies, stillpoint::PaperPolicies,
                    stillpoint::PaperRigidPolicies>);
static_assert(std::is_same_v<stillpoint::FrameFilter<>, stillpoint::FrameFilter<stillpoint::DefaultPolicies>>);

}  // namespace forward_declarations
