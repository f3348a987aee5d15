#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "render/integrators/integrator.h"
#include "render/integrators/wavefront.h"
#include "render/prepare/prepared_scene.h"
#include "render/shading/illumination.h"
#include "render/shading/stream_surfaces.h"
#include "simd/abi/kernel_table.h"
#include "simd/stream/aligned_array.h"

namespace boule {

/// What integrators have in common that follow rays depth by depth, a stream at a time: the rays'
/// hits, the points' direct light, the sum of both. Each says what a hit sends back by itself, on
/// which points light falls, and which rays go on.
class StreamIntegrator : public Integrator {
 public:
  bool trace(const CameraRays& camera, Color* radiance) final;
  [[nodiscard]] RayCounts counts() const final { return {primary_, shadow_, wavefront_.spawned()}; }
  [[nodiscard]] SampleFaults faults() const final { return wavefront_.faults(); }

 protected:
  /// Rays first .. end - 1 of a stream, a block of StreamSurfaces.
  struct Block {
    const PathStream& stream;
    std::size_t first, end;
  };

  /// A ray of the block that met what sends light on.
  struct Met {
    std::uint32_t ray;
    const FlatMaterial* material;
  };

  /// `scene` and `kernels` must outlive the integrator.
  StreamIntegrator(const PreparedScene& scene, const KernelTable& kernels,
                   const IntegratorSettings& settings);

  /// From now on this light, of the scene, shines on all points that are lit.
  void use_light(const Light& light);

  /// Called before the first stream of these rays, and before each stream of so many.
  virtual void start(const CameraRays&) {}
  virtual void make_room(std::size_t) {}

  /// Sets radiance(k) for every ray k of the block, tells illumination_ of lit points, and spawns
  /// the rays that go on, parents in order.
  virtual void shade(const Block& block) = 0;

  /// Called when all blocks of a stream are shaded and its lights added.
  virtual void add_more_light() {}

  /// Finds the surfaces of all hits of the block.
  void find_surfaces(const Block& block);

  /// True for each of these shadow rays that is blocked; valid until the next call.
  const std::uint8_t* find_blocked(const RayStream& shadow_rays, Coherence coherence);

  [[nodiscard]] Hit hit(std::size_t ray) const { return hits_.get(ray); }
  [[nodiscard]] Color& radiance(std::size_t ray) { return radiance_[ray]; }
  [[nodiscard]] bool ends(const PathStream& stream) const {
    return stream.depth == settings_.max_depth;
  }

  const PreparedScene& scene_;
  const KernelTable& kernels_;
  IntegratorSettings settings_;
  Wavefront wavefront_;
  Illumination illumination_;
  StreamSurfaces surfaces_;
  std::vector<Met> met_;  ///< working memory of one block

 private:
  struct PlacedLight {
    const Light* light;
    ShadowTarget target;
  };

  void trace_stream(const PathStream& stream, Coherence coherence);
  void add_light(const PlacedLight& light);
  [[nodiscard]] bool cancelled() const;

  GeometryView geometry_;
  std::vector<PlacedLight> lights_;
  std::uint64_t primary_ = 0, shadow_ = 0;

  // Working memory of one stream.
  HitBuffer hits_;
  std::vector<Color> radiance_;  ///< by ray
  AlignedArray<std::uint8_t> blocked_;
};

}  // namespace boule
