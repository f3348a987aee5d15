#pragma once

#include <cstdint>
#include <vector>

#include "core/math/light_cone.h"
#include "core/math/sobol.h"
#include "render/integrators/random_numbers.h"
#include "render/integrators/stream_integrator.h"
#include "render/shading/lobe_sampler.h"

namespace boule {

/// Path tracing (Kajiya, "The rendering equation", 1986): every ray goes on as one ray in a random
/// direction. Light of spheres and of the environment's image is found in two ways at each point,
/// weighted by the power heuristic (Veach, "Robust Monte Carlo methods for light transport
/// simulation", 1997, 9.2): by light sampling (next-event estimation), which is a shadow ray to one
/// sphere light, to one emissive sphere or into the image, and by the direction in which the path
/// goes on. Point and directional lights are found by shadow rays only, one to each of them at
/// every point. Paths end by Russian roulette, or after max_depth bounces; at their last point
/// light is found by light sampling only. The random numbers of a sample depend on its pixel, its
/// index, the depth and the seed, and on nothing else.
class Path final : public StreamIntegrator {
 public:
  /// `scene`, prepared for Method::path, and `kernels` must outlive the integrator.
  Path(const PreparedScene& scene, const KernelTable& kernels, const IntegratorSettings& settings);

 private:
  /// The radiance that a light adds to ray `ray`, unless the shadow ray is blocked.
  struct SampledLight {
    std::uint32_t ray;
    Color radiance;
  };
  /// The hit of ray `ray`, whose material sends light on.
  struct Point {
    std::uint32_t ray;
    bool lit;  ///< direct light counts for the material
    Surface surface;
    LobeSampler lobes;

    Point(std::uint32_t met_by, const FlatMaterial& material, const Surface& met)
        : ray(met_by), lit(takes_direct_light(material)), surface(met), lobes(material, met) {}
  };
  /// A point, and the light that was picked for it.
  struct PickedLight {
    const Point* point;
    const AreaLight* light;
  };
  /// Light from a direction that was chosen with a density.
  struct LightSample {
    Vec3d direction;
    double density;
    Color radiance;
  };
  /// What the random numbers of a sample depend on, beside depth and use.
  struct RandomKey {
    std::uint64_t pixel;
    std::uint32_t sample;
  };
  /// What the random numbers of one depth are used for.
  enum class Use { bounce, light, roulette };

  void start(const CameraRays& camera) override;
  void make_room(std::size_t rays) override;
  void shade(const Block& block) override;
  void add_more_light() override;
  const FlatMaterial* find_emission(const PathStream& stream, std::uint32_t ray);
  void add_point(const ScatteringHit& hit, const Surface& surface);
  void sample_lights(const PathStream& stream);
  bool sample_environment(const PathStream& stream, const Point& point, UnitPair& numbers);
  void sample_spheres(const PathStream& stream);
  void add_shadow_ray(const PathStream& stream, const Point& point, const Ray& ray,
                      const LightSample& light);
  void continue_paths(const PathStream& stream);
  void choose_directions(const PathStream& stream);
  bool survives(const PathStream& stream, const Point& point, UnitPair numbers, Bounce& bounce);
  void find_numbers(const PathStream& stream, Use use);
  [[nodiscard]] Color weighted_background(const PathStream& stream, std::uint32_t ray) const;
  [[nodiscard]] double emitter_density(const Vec3d& org, const Hit& hit,
                                       const Color& radiance) const;
  [[nodiscard]] Color crossed_lights(const Ray& ray, double density, double t) const;
  [[nodiscard]] double weight_of_hit(double density, double light_density) const;
  [[nodiscard]] double weight_of_light(double light_density, double density, bool last) const;

  PixelKeys keys_;
  double environment_share_;            ///< probability to sample the environment, not a sphere
  bool samples_lights_;                 ///< light sampling is on, and there is a light to sample
  bool delta_lights_ = false;           ///< there are point or directional lights
  std::vector<RandomKey> random_keys_;  ///< by sample

  // Working memory of a stream.
  RayBuffer shadow_rays_;                     ///< to sampled lights
  std::vector<SampledLight> sampled_lights_;  ///< by shadow ray
  // Working memory of a block.
  std::vector<Point> points_;
  RandomNumbers numbers_;  ///< by point
  std::vector<PickedLight> picked_lights_;
  LightConeBuffer light_cones_;               ///< by picked light
  std::vector<LobeSampler::Choice> choices_;  ///< by point
  LocalDirectionBuffer directions_;           ///< by point
};

}  // namespace boule
