#pragma once

#include <cstdint>
#include <vector>

#include "core/math/sobol.h"
#include "render/integrators/random_numbers.h"
#include "render/integrators/stream_integrator.h"
#include "render/shading/material_finder.h"
#include "render/shading/path_material.h"
#include "simd/stream/path_buffers.h"

namespace boule {

/// Path tracing (Kajiya, "The rendering equation", 1986): every ray continues as one ray in a
/// random direction. The light of spheres and of the environment's image is found in two ways at
/// each point, weighted by the power heuristic (Veach, "Robust Monte Carlo methods for light
/// transport simulation", 1997, 9.2). One is light sampling (next-event estimation): a shadow ray
/// to one sphere light, to one emissive sphere or into the image. The other is the direction in
/// which the path continues. Point and directional lights are found by shadow rays only, one to
/// each of them at every point. Paths end by Russian roulette, or after max_depth bounces; at their
/// last point light is found by light sampling only. The random numbers of a sample depend only on
/// its pixel, its index, the depth and the seed.
class Path final : public StreamIntegrator {
 public:
  /// `scene`, prepared for Method::path, and `kernels` must outlive the integrator.
  Path(const PreparedScene& scene, const KernelTable& kernels, const IntegratorSettings& settings);

 private:
  using RandomKey = RandomNumbers::Key;
  /// The uses of the random numbers of one depth.
  enum class Use { bounce, light, roulette };
  /// A kernel that continues the paths at the points of one kind.
  using Continue = void (*)(const LobePoints&, const PathStep&, SampledLights&, GoingOn&);

  void start(const CameraRays& camera) override;
  void make_room(std::size_t rays) override;
  void shade(const Block& block) override;
  void add_more_light() override;
  [[nodiscard]] Color see_image(const PathStream& stream, std::size_t ray) const override;
  void meet_materials(const Block& block);
  [[nodiscard]] Color emitted(const PathStream& stream, std::uint32_t ray, const Hit& met,
                              const Color& radiance) const;
  void light_points(const Block& block);
  void continue_paths(const Block& block);
  void continue_points(const Block& block, const LobePoints& points, Continue kernel);
  void start_shadows_by_epsilon(std::size_t first);
  void find_numbers(const PathStream& stream, const LobePoints& points, Use use,
                    RandomNumbers& numbers);
  void sample_environment(const LobePoints& points);
  [[nodiscard]] double emitter_density(const Vec3d& org, const Hit& hit,
                                       const Color& radiance) const;
  [[nodiscard]] double weight_of_hit(double density, double light_density) const;

  PixelKeys keys_;
  double environment_share_;   ///< probability to sample the environment rather than a sphere
  bool samples_lights_;        ///< light sampling is on, and there is a light to sample
  bool delta_lights_ = false;  ///< there are point or directional lights
  HitWeight hit_weight_;
  std::vector<RandomKey> random_keys_;  ///< by sample
  MaterialFinder<PathMaterial> materials_;

  // Working memory of a stream.
  SampledLightBuffer shadow_buffer_;
  SampledLights shadows_{};
  // Working memory of a block.
  AlignedArray<std::uint32_t> kinds_;       ///< by ray
  std::vector<const FlatMaterial*> lobes_;  ///< by ray
  LobePointBuffer matte_, glossy_, clear_;
  GoingOn going_on_{};
  RandomNumbers light_numbers_, bounce_numbers_, roulette_numbers_;  ///< by point
  GivenLightBuffer given_light_;                                     ///< by point
};

}  // namespace boule
