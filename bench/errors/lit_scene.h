#pragma once

#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

#include "bench/errors/float_remedies.h"
#include "core/scene/scene.h"
#include "core/surface.h"
#include "simd/geometry/geometry.h"
#include "tests/support/long_double_tracer.h"

namespace boule::bench {

/// What a camera sees at one place of the picture.
struct SeenPoint {
  bool hit = false;        ///< if not, nothing else means anything
  bool right_hit = false;  ///< the truth meets the same primitive
  test::Lit truth = test::Lit::unsure;
  Surface surface{};
  FloatPoint rounded;  ///< the same for float renderers
  double cosine = 0;   ///< N.L; what is turned away from the light is dark for everyone

  /// The truth is the same hit, and knows whether it is lit.
  [[nodiscard]] bool decided() const { return hit && right_hit && truth != test::Lit::unsure; }
};

/// A scene with one point light, to be asked what is lit in it. `scene` must outlive it.
class LitScene {
 public:
  explicit LitScene(const Scene& scene);

  /// What the camera's rays through these raster points meet, and what is true of it.
  [[nodiscard]] std::vector<SeenPoint> see(const std::vector<std::pair<double, double>>& raster,
                                           int width, int height) const;

  /// lit[i] = 1 where the light reaches points[i], with one of the floats' remedies. Misses: 0.
  [[nodiscard]] std::vector<std::uint8_t> lit(const std::vector<SeenPoint>& points,
                                              const FloatRemedy& remedy) const;
  /// The same by the renderer's own shadow rays and the kernels.
  [[nodiscard]] std::vector<std::uint8_t> lit(const std::vector<SeenPoint>& points) const;

 private:
  [[nodiscard]] SeenPoint find_point(const Ray& ray, const Hit& hit) const;

  const Scene& scene_;
  Vec3f light_;
  Geometry geometry_;
  test::LongDoubleTracer truth_;
};

}  // namespace boule::bench
