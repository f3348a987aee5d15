#pragma once

#include <cstddef>
#include <vector>

#include "core/math/color.h"
#include "render/integrators/scene_search.h"
#include "render/prepare/fog.h"
#include "render/prepare/prepared_scene.h"
#include "simd/abi/kernel_table.h"
#include "simd/stream/stream_buffer.h"

namespace boule {

/// The films of ghosts between the camera and what its rays hit: of each ray the first, where it
/// hits a ghost before anything else. So ghosts that overlap have one film around them, and nothing
/// is random. The film's share of what is seen is a / (a + (1 - a) c), where a is the ghost's
/// opacity and c the cosine between ray and normal: nearly that of a layer that is passed at a
/// slant. Its colour is the ghost's, whatever the scene's lights are.
class GhostFilms {
 public:
  /// `scene`, which has ghosts, and `kernels` must outlive it.
  GhostFilms(const PreparedScene& scene, const KernelTable& kernels)
      : scene_(scene), search_(*scene.ghosts->scene, kernels) {}

  /// Finds the films before these hits of camera rays. Fog lies before films, too.
  void find(const RayStream& rays, const Query& query, const HitStream& hits, const Fog& fog);

  /// Puts the films before what each ray found.
  void add(Color* radiance) const;

  /// The coverage of what is seen, of which `behind` is covered where there is no film.
  [[nodiscard]] float coverage(std::size_t ray, float behind) const {
    const Film& film = films_[ray];
    return film.share * (1 - film.veil) + (1 - film.share) * behind;
  }

 private:
  struct Film {
    float share = 0;  ///< of what is seen
    float veil = 0;   ///< the share of fog in its colour
    Color color;
  };

  [[nodiscard]] Film film_of(const Ray& ray, const Hit& hit, const Hit& met, const Fog& fog) const;

  const PreparedScene& scene_;
  SceneSearch search_;
  Experience experience_;
  HitBuffer hits_, caps_;
  std::vector<Film> films_;  ///< by camera ray
};

}  // namespace boule
