#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

#include "render/integrators/ghost_films.h"
#include "render/integrators/integrator.h"
#include "render/integrators/scene_search.h"
#include "render/integrators/wavefront.h"
#include "render/prepare/prepared_scene.h"
#include "render/shading/illumination.h"
#include "render/shading/stream_surfaces.h"
#include "simd/abi/kernel_table.h"
#include "simd/stream/aligned_array.h"
#include "simd/stream/path_buffers.h"

namespace boule {

/// The part of an integrator that follows rays depth by depth, a stream at a time: it finds their
/// hits and the direct light there, and adds up the radiance. A derived class decides the radiance
/// of a hit without direct light, the hits that direct light reaches, and the rays that continue.
class StreamIntegrator : public Integrator {
 public:
  bool trace(const CameraRays& camera, Color* radiance) final;
  [[nodiscard]] RayCounts counts() const final { return {primary_, shadow_, wavefront_.spawned()}; }
  [[nodiscard]] SampleFaults faults() const final { return wavefront_.faults(); }

 protected:
  /// Rays first .. end - 1 of a stream, which are a block of StreamSurfaces.
  struct Block {
    const PathStream& stream;
    std::size_t first, end;
  };

  /// The largest number of rays that continue from one.
  static constexpr std::size_t most_spawned = 2;

  /// `scene` and `kernels` must outlive the integrator.
  StreamIntegrator(const PreparedScene& scene, const KernelTable& kernels,
                   const IntegratorSettings& settings, RaysPerDepth rays);

  /// From now on, the direct light of this light of the scene is added to all lit hits.
  void use_light(const Light& light);

  /// From now on rays see this light by their direction. If the scene has a backdrop, the camera's
  /// own rays see it in place of the background.
  void use_seen(const SeenLight& seen);

  /// Called before the first stream of these camera rays.
  virtual void start(const CameraRays&) {}
  /// Called before each stream, with the number of rays to make room for.
  virtual void make_room(std::size_t) {}

  /// Sets the radiance_ of every ray of the block, adds the lit hits to illumination_, and spawns
  /// the rays that continue, parents in order.
  virtual void shade(const Block& block) = 0;

  /// Called when all blocks of a stream are shaded and their direct light is added.
  virtual void add_more_light() {}

  /// Sets the radiance of the block's rays to the light that they find by their direction.
  void see_light(const Block& block);

  /// The background for a ray that misses, if the background is an image, which kernels leave out.
  [[nodiscard]] virtual Color see_image(const PathStream& stream, std::size_t ray) const;

  /// Finds the surfaces of all hits of the block.
  void find_surfaces(const Block& block);

  /// Finds the blocked ones among these shadow rays: 1 if blocked, otherwise 0. Valid until the
  /// next call.
  const std::uint8_t* find_blocked(const RayStream& shadow_rays, Coherence coherence);

  [[nodiscard]] Hit hit(std::size_t ray) const { return hits_.get(ray); }
  /// The lecture's epsilon at which shadow rays start; none: they start by themselves.
  [[nodiscard]] std::optional<Illumination::Epsilon> epsilon() const;
  [[nodiscard]] bool ends(const PathStream& stream) const {
    return stream.depth == settings_.max_depth;
  }

  const PreparedScene& scene_;
  const KernelTable& kernels_;
  IntegratorSettings settings_;
  Wavefront wavefront_;
  Illumination illumination_;
  StreamSurfaces surfaces_;
  GeometryView geometry_;
  SceneSearch search_;
  // Working memory of one stream.
  HitBuffer hits_;
  HitBuffer caps_;        ///< of scenes that are cut
  HitStream met_{};       ///< the hits as the surfaces that were met: SceneSearch::surfaces()
  ColorBuffer radiance_;  ///< by ray

 private:
  struct TargetedLight {
    const Light* light;
    ShadowTarget target;
    LightIntensity intensity;
  };

  /// Experience of one depth, because rays of one depth are more alike than those of different
  /// depths.
  struct DepthExperience {
    Experience nearest, shadow;
  };

  void trace_stream(const PathStream& stream, const CameraRays& camera);
  /// The experience with rays of the current stream.
  [[nodiscard]] DepthExperience& experience();
  void find_float_points(const PathStream& stream);
  void find_fog(const PathStream& stream);
  void add_fog(Color* radiance) const;
  void tell_coverage(std::uint8_t* covered) const;
  void add_light(const TargetedLight& light);
  void record_shadow(const TargetedLight& light, const RayStream& rays,
                     const std::uint8_t* blocked);
  [[nodiscard]] bool cancelled() const;

  std::vector<TargetedLight> lights_;
  SeenLight seen_{}, seen_by_camera_{};
  std::uint64_t primary_ = 0, shadow_ = 0;
  std::array<DepthExperience, 8> experience_;  ///< by depth; the last one is of all deeper ones too
  int depth_ = 0;                              ///< of the current stream

  /// What the fog in front of a camera ray's hit does.
  struct Veil {
    float share = 0;
    Color color;
  };
  std::vector<Veil> veils_;           ///< by camera ray, if there is fog
  std::optional<GhostFilms> ghosts_;  ///< if there are any; not of a record

  // Working memory of one stream.
  std::vector<Vec3f> float_points_;  ///< by ray, if shadow rays start by an epsilon
  AlignedArray<std::uint8_t> blocked_;
};

}  // namespace boule
