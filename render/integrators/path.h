#pragma once

#include <cstdint>
#include <vector>

#include "core/math/sobol.h"
#include "render/integrators/stream_integrator.h"
#include "render/shading/light_cone.h"
#include "render/shading/lobes.h"

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
  /// A ray's hit that seeks light.
  struct Seeker {
    const PathStream& stream;
    std::uint32_t ray;
    const Surface& surface;
    const Lobes& lobes;
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
  bool meet(const PathStream& stream, std::uint32_t index);
  void shade_hit(const PathStream& stream, std::uint32_t index, const Surface& surface);
  void seek_light(const PathStream& stream, std::uint32_t index, const Surface& surface,
                  const Lobes& lobes);
  void go_on(const PathStream& stream, std::uint32_t index, const Surface& surface,
             const Lobes& lobes);
  void seek(const Seeker& seeker, const Ray& way, const Sought& light);
  [[nodiscard]] Color seen_background(const Ray& ray, double density) const;
  [[nodiscard]] Color crossed_lights(const Ray& ray, double density, double t) const;
  [[nodiscard]] double weight_of_hit(double density, double light_density) const;
  [[nodiscard]] double weight_of_light(double light_density, double density, bool last) const;
  [[nodiscard]] UnitPair numbers(const PathStream& stream, std::uint32_t index, Use use) const;

  PixelKeys keys_;
  double environment_share_;            ///< how often the environment is sought, not a sphere
  bool seeks_;                          ///< there is something to seek, by rays to it
  bool delta_lights_ = false;           ///< there are point or directional lights
  std::vector<RandomKey> random_keys_;  ///< by sample

  RayBuffer shadow_rays_;              ///< of a stream: to what is sought
  std::vector<Arrival> arrivals_;      ///< by shadow ray
  std::vector<std::uint32_t> points_;  ///< of a block: rays whose surface matters
};

}  // namespace boule
