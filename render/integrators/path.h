#pragma once

#include <cstdint>
#include <vector>

#include "core/math/light_cone.h"
#include "core/math/sobol.h"
#include "render/integrators/random_numbers.h"
#include "render/integrators/stream_integrator.h"
#include "render/shading/lobe_sampler.h"

namespace boule {

/// Path tracing (Kajiya, "The rendering equation", 1986): every ray goes on as one, by chance. At
/// each point light is sought in two ways, weighted by the power heuristic (Veach, "Robust Monte
/// Carlo methods for light transport simulation", 1997, 9.2): by a ray to one sphere light or
/// emissive sphere or into the environment's image, and by where the path goes on to. Point and
/// directional lights have one way only, and each has its shadow ray at every point. Paths end by
/// Russian roulette, or after max_depth bounces: there light is sought in the first way alone. A
/// sample's numbers depend on its pixel, its index, the depth and the seed: nothing else.
class Path final : public StreamIntegrator {
 public:
  /// `scene`, prepared for Method::path, and `kernels` must outlive the integrator.
  Path(const PreparedScene& scene, const KernelTable& kernels, const IntegratorSettings& settings);

 private:
  /// What arrives at ray `ray`'s hit from a light, unless its shadow ray is blocked.
  struct Arrival {
    std::uint32_t ray;
    Color radiance;
  };
  /// A ray's hit from which light is sent on.
  struct Point {
    std::uint32_t ray;
    bool lit;  ///< light sources shine on it
    Surface surface;
    LobeSampler lobes;

    Point(std::uint32_t met_by, const FlatMaterial& material, const Surface& met)
        : ray(met_by), lit(takes_direct_light(material)), surface(met), lobes(material, met) {}
  };
  /// A point that seeks a sphere.
  struct Seeker {
    const Point* point;
    const AreaLight* light;
  };
  /// Light in a direction that was chosen with a density.
  struct Sought {
    Vec3d direction;
    double density;
    Color radiance;
  };
  /// What a sample's random numbers depend on.
  struct RandomKey {
    std::uint64_t pixel;
    std::uint32_t sample;
  };
  /// The random numbers of one depth of a path, each set for a use of its own.
  enum class Use { bounce, light, roulette };

  void start(const CameraRays& camera) override;
  void make_room(std::size_t rays) override;
  void shade(const Block& block) override;
  void add_more_light() override;
  const FlatMaterial* meet(const PathStream& stream, std::uint32_t ray);
  void add_point(const Met& met, const Surface& surface);
  void seek_lights(const PathStream& stream);
  bool seek_environment(const PathStream& stream, const Point& point, UnitPair& numbers);
  void seek_spheres(const PathStream& stream);
  void seek(const PathStream& stream, const Point& point, const Ray& way, const Sought& light);
  void go_on(const PathStream& stream);
  void choose_ways(const PathStream& stream);
  bool survives(const PathStream& stream, const Point& point, UnitPair numbers, Bounce& bounce);
  void find_numbers(const PathStream& stream, Use use);
  [[nodiscard]] Color seen_background(const Vec3f& dir, double density) const;
  [[nodiscard]] double sought_density(const Vec3d& org, std::int32_t id) const;
  [[nodiscard]] Color crossed_lights(const Ray& ray, double density, double t) const;
  [[nodiscard]] double weight_of_hit(double density, double light_density) const;
  [[nodiscard]] double weight_of_light(double light_density, double density, bool last) const;

  PixelKeys keys_;
  double environment_share_;            ///< how often the environment is sought, not a sphere
  bool seeks_;                          ///< there is something to seek, by rays to it
  bool delta_lights_ = false;           ///< there are point or directional lights
  std::vector<RandomKey> random_keys_;  ///< by sample

  // Working memory of a stream.
  RayBuffer shadow_rays_;          ///< to what is sought
  std::vector<Arrival> arrivals_;  ///< by shadow ray
  // Working memory of a block.
  std::vector<Point> points_;
  RandomNumbers numbers_;  ///< by point
  std::vector<Seeker> seekers_;
  LightConeBuffer seek_;                      ///< by seeker
  std::vector<LobeSampler::Choice> choices_;  ///< by point
  LocalDirectionBuffer turns_;                ///< by point
};

}  // namespace boule
