// SPDX-FileCopyrightText: 2026 The stillpoint authors
// SPDX-License-Identifier: MIT
#pragma once

// FrameFilter<> and FrameFilter<WithMovers<>> of a host that links stillpoint::compiled: the library has the filter,
// with DefaultPolicies, and here are declarations alone. stillpoint.hpp includes this in place of the pipeline where
// STILLPOINT_COMPILED is defined, as the target does. What is called on the filter is the same in both.

#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "stillpoint/core/abi.hpp"
#include "stillpoint/core/camera.hpp"
#include "stillpoint/core/frame.hpp"
#include "stillpoint/core/frame_result.hpp"
#include "stillpoint/core/keypoint.hpp"
#include "stillpoint/depth/depth_noise.hpp"
#include "stillpoint/fwd.hpp"
#include "stillpoint/gate/tail_gate.hpp"
#include "stillpoint/pipeline/frame_check.hpp"
#include "stillpoint/verdict/keep_floor.hpp"

namespace stillpoint {

struct GuardedDepth;
class DepthRegistration;
class TemporalHoleFilling;
class PropagatedPrior;
struct PatchMatcher;
class SupportMotion;
class ReprojectionScore;
class SurfaceClusters;
class EvidenceMemory;
class MaskPrediction;
class MoverTracking;

namespace detail {

class CompiledEngine;

/// The library's functions, for callers with an ABI. It has those for its own; for another host the linker finds none.
template <class HostAbi>
struct CompiledFilter {
  using Engine = CompiledEngine;

  struct Destroy {
    void operator()(Engine* engine) const noexcept { destroy(engine); }
  };

  /// The filter's members, which the engine owns.
  struct Stages {
    Camera& camera;
    FrameCheck& frame_check;
    AnyDepthNoise& depth_noise;
    GuardedDepth& depth_lookup;
    DepthRegistration& depth_registration;
    TemporalHoleFilling& hole_filling;
    PropagatedPrior& prior;
    PatchMatcher& matcher;
    SupportMotion& ego_motion;
    ReprojectionScore& scorer;
    TailGate& gate;
    SurfaceClusters& classifier;
    EvidenceMemory& memory;
    KeepFloor& keep_floor;
    MaskPrediction& mask_prediction;
  };

  static Engine* create(const Camera& camera, bool has_movers);
  static void destroy(Engine* engine) noexcept;
  static Stages stages(Engine& engine);
  static MoverTracking& movers(Engine& engine);
  static const FrameResult& filter_frame(Engine& engine, const FrameView& frame, span<const Vector2f> pixels);
  static void feedback(Engine& engine, const Pose& world_from_camera);
  static void expect_motion(Engine& engine, const Pose& current_from_reference);
  static void expect_dynamic(Engine& engine, span<const std::uint8_t> is_dynamic);
  static void predicted_keep_mask(Engine& engine, double timestamp_s, int margin_px, ImageBuffer& mask);
  static std::string options_error(Engine& engine);
  static void reset(Engine& engine);
};

/// Every file that includes this asks the linker for the library of its own ABI, whatever it calls.
#if defined(__GNUC__)
[[gnu::used]] static void (*const compiled_filter_of_this_abi)(CompiledEngine*) noexcept =
    &CompiledFilter<Abi>::destroy;
#endif

}  // namespace detail

/// `FrameFilter<DefaultPolicies>` in the library stillpoint::compiled; filter_frame.hpp says what its functions do. Its
/// stages are references: to set options of one that is only declared here, include the stage's header.
template <>
class FrameFilter<CompiledPolicies> {
 protected:
  using Compiled = detail::CompiledFilter<Abi>;

 private:
  std::unique_ptr<Compiled::Engine, Compiled::Destroy> engine_;  // made before what refers to it

 public:
  using Camera = stillpoint::Camera;
  using DepthNoise = AnyDepthNoise;
  using Prior = PropagatedPrior;
  using Matcher = PatchMatcher;
  using EgoMotion = SupportMotion;
  using Memory = EvidenceMemory;

  explicit FrameFilter(const Camera& camera_model) : FrameFilter(Compiled::create(camera_model, false)) {}
  FrameFilter(FrameFilter&&) noexcept = default;

  Camera& camera;                         ///< intrinsics and distortion; one of another size begins anew
  FrameCheck& frame_check;                ///< which frames can be judged at all?
  AnyDepthNoise& depth_noise;             ///< how wrong is a depth?
  GuardedDepth& depth_lookup;             ///< which depth belongs to a pixel?
  DepthRegistration& depth_registration;  ///< does depth lie on the image?
  TemporalHoleFilling& hole_filling;      ///< what lies where the depth image has a hole?
  PropagatedPrior& prior;                 ///< where may something move?
  PatchMatcher& matcher;                  ///< where was each feature before?
  SupportMotion& ego_motion;              ///< how did the camera move?
  ReprojectionScore& scorer;              ///< how badly does each feature disagree with that motion?
  TailGate& gate;                         ///< which disagreement is more than noise?
  SurfaceClusters& classifier;            ///< which features move together?
  EvidenceMemory& memory;                 ///< what did we know of this feature?
  KeepFloor& keep_floor;                  ///< how much must be left?
  MaskPrediction& mask_prediction;        ///< where will the coming frame show moving objects?

  template <class Keypoints>
  const FrameResult& filter_frame(const FrameView& frame, const Keypoints& keypoints) {
    return Compiled::filter_frame(*engine_, frame, read_pixels(keypoints, pixels_));
  }
  void feedback(const Pose& world_from_camera) { Compiled::feedback(*engine_, world_from_camera); }
  void expect_motion(const Pose& current_from_reference) { Compiled::expect_motion(*engine_, current_from_reference); }
  void expect_dynamic(span<const std::uint8_t> is_dynamic) { Compiled::expect_dynamic(*engine_, is_dynamic); }
  void predicted_keep_mask(double timestamp_s, int margin_px, ImageBuffer& mask) {
    Compiled::predicted_keep_mask(*engine_, timestamp_s, margin_px, mask);
  }
  std::string options_error() { return Compiled::options_error(*engine_); }
  void reset() { Compiled::reset(*engine_); }

 protected:
  explicit FrameFilter(Compiled::Engine* engine) : FrameFilter(engine, Compiled::stages(*engine)) {}

 private:
  FrameFilter(Compiled::Engine* engine, const Compiled::Stages& stages)
      : engine_(engine),
        camera(stages.camera),
        frame_check(stages.frame_check),
        depth_noise(stages.depth_noise),
        depth_lookup(stages.depth_lookup),
        depth_registration(stages.depth_registration),
        hole_filling(stages.hole_filling),
        prior(stages.prior),
        matcher(stages.matcher),
        ego_motion(stages.ego_motion),
        scorer(stages.scorer),
        gate(stages.gate),
        classifier(stages.classifier),
        memory(stages.memory),
        keep_floor(stages.keep_floor),
        mask_prediction(stages.mask_prediction) {}

  std::vector<Vector2f> pixels_;
};

template <>
struct WithMovers<CompiledPolicies> {
  using Movers = MoverTracking;
};

/// `FrameFilter<WithMovers<DefaultPolicies>>` in the library: the same filter, whose results have movers.
template <>
class FrameFilter<WithMovers<CompiledPolicies>> : public FrameFilter<CompiledPolicies> {
 public:
  explicit FrameFilter(const Camera& camera_model) : FrameFilter(Compiled::create(camera_model, true)) {}

  MoverTracking& movers;  ///< which objects move, and how?

 private:
  explicit FrameFilter(Compiled::Engine* engine)
      : FrameFilter<CompiledPolicies>(engine), movers(Compiled::movers(*engine)) {}
};

}  // namespace stillpoint
