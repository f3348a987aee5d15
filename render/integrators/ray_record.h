#pragma once

#include <atomic>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "core/math/color.h"
#include "core/math/ray.h"

namespace boule {

/// The purpose of a ray in Whitted's recursion.
enum class RayKind { primary, reflection, refraction, shadow };

/// One ray of the recursion, as a teacher draws it on the board.
struct RecordedRay {
  RayKind kind = RayKind::primary;
  int parent = -1;  ///< an earlier ray's index; -1: none
  int depth = 0;    ///< bounces before it
  Ray ray{};
  Hit hit{};           ///< of a shadow ray: the hit that blocks it
  Hit met{};           ///< the same as a surface: SceneSearch::surfaces(); not of shadow rays
  Color weight{};      ///< in the light that its parent returns
  Color throughput{};  ///< in the sample
  Color own{};         ///< light found by the ray itself; of a shadow ray: the light that it lets
                       ///< through
  std::size_t light = 0;  ///< of a shadow ray: index of its light
};

/// The rays of one sample, in the order of the recursion: parents before children, shadow rays
/// after the ray whose hit they leave. An integrator fills it for one camera ray, with streams of
/// one ray each (IntegratorSettings::record).
class RayRecord {
 public:
  static constexpr std::size_t most_rays = 4096;

  /// Forgets all rays.
  void start();
  /// Begins the next ray of the recursion, which the last calls of expect() announced.
  void begin(const Ray& ray, const Hit& hit, const Hit& met, const Color& throughput);
  /// Adds a shadow ray of the current ray to one of the lights.
  void add_shadow(std::size_t light, const Ray& ray, const Hit& hit, const Color& arriving);
  /// Announces a child of the current ray.
  void expect(RayKind kind, const Color& weight);
  /// Sets the light that the current ray found itself.
  void finish(const Color& own);

  [[nodiscard]] const std::vector<RecordedRay>& rays() const { return rays_; }

  /// True once there are more rays than a reader can use. The record then keeps no more, and
  /// IntegratorSettings cancels by it.
  [[nodiscard]] const std::atomic<bool>& full() const { return full_; }

  /// The radiance of the sample: summed per depth, and then over the depths, in float, as the
  /// renderer does.
  [[nodiscard]] Color total() const;
  /// The light that each ray returns to its parent: `own` and the weighted light of its children,
  /// in their order. Of a shadow ray: `own`.
  [[nodiscard]] std::vector<Color> returned() const;

 private:
  struct Expected {
    RayKind kind;
    int parent;
    Color weight;
  };

  std::vector<RecordedRay> rays_;
  std::vector<Expected> waiting_;   ///< a stack
  std::vector<Expected> children_;  ///< of the current ray, in order
  std::size_t current_ = 0;
  std::atomic<bool> full_{false};
};

}  // namespace boule
