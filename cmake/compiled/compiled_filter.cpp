// SPDX-FileCopyrightText: 2026 The stillpoint authors
// SPDX-License-Identifier: MIT

// The one place where hosts of stillpoint::compiled have the pipeline instantiated.

#include <stillpoint/compiled.hpp>
#include <stillpoint/filter_frame.hpp>
#include <stillpoint/policies/with_movers.hpp>

namespace stillpoint {

// One filter for hosts with movers and without: switched off, they cost nothing, and no verdict depends on them.
template class FrameFilter<WithMovers<DefaultPolicies>>;

namespace detail {

class CompiledEngine : public FrameFilter<WithMovers<DefaultPolicies>> {
 public:
  using FrameFilter<WithMovers<DefaultPolicies>>::FrameFilter;
};

template <class HostAbi>
auto CompiledFilter<HostAbi>::create(const Camera& camera, bool has_movers) -> Engine* {
  auto* const engine = new Engine(camera);
  engine->movers.is_enabled = has_movers;
  return engine;
}

template <class HostAbi>
void CompiledFilter<HostAbi>::destroy(Engine* engine) noexcept {
  delete engine;
}

template <class HostAbi>
auto CompiledFilter<HostAbi>::stages(Engine& engine) -> Stages {
  return {engine.camera,       engine.frame_check, engine.depth_noise, engine.depth_lookup, engine.depth_registration,
          engine.hole_filling, engine.prior,       engine.matcher,     engine.ego_motion,   engine.scorer,
          engine.gate,         engine.classifier,  engine.memory,      engine.keep_floor,   engine.mask_prediction};
}

template <class HostAbi>
MoverTracking& CompiledFilter<HostAbi>::movers(Engine& engine) {
  return engine.movers;
}

template <class HostAbi>
const FrameResult& CompiledFilter<HostAbi>::filter_frame(Engine& engine, const FrameView& frame,
                                                         span<const Vector2f> pixels) {
  return engine.filter_frame(frame, pixels);
}

template <class HostAbi>
void CompiledFilter<HostAbi>::feedback(Engine& engine, const Pose& world_from_camera) {
  engine.feedback(world_from_camera);
}

template <class HostAbi>
void CompiledFilter<HostAbi>::expect_motion(Engine& engine, const Pose& current_from_reference) {
  engine.expect_motion(current_from_reference);
}

template <class HostAbi>
void CompiledFilter<HostAbi>::expect_dynamic(Engine& engine, span<const std::uint8_t> is_dynamic) {
  engine.expect_dynamic(is_dynamic);
}

template <class HostAbi>
void CompiledFilter<HostAbi>::predicted_keep_mask(Engine& engine, double timestamp_s, int margin_px,
                                                  ImageBuffer& mask) {
  engine.predicted_keep_mask(timestamp_s, margin_px, mask);
}

template <class HostAbi>
std::string CompiledFilter<HostAbi>::options_error(Engine& engine) {
  return engine.options_error();
}

template <class HostAbi>
void CompiledFilter<HostAbi>::reset(Engine& engine) {
  engine.reset();
}

template struct CompiledFilter<Abi>;

}  // namespace detail
}  // namespace stillpoint
