#include "render/integrators/ghost_films.h"

#include <algorithm>
#include <variant>

#include "core/surface.h"
#include "render/shading/background_radiance.h"

namespace boule {
void GhostFilms::find(const RayStream& rays, const Query& query, const HitStream& hits,
                      const Fog& fog) {
  films_.assign(rays.size, {});
  hits_.resize(rays.size);
  const Query own{query.solver, query.form, query.coherence, &experience_};
  search_.closest_hit(rays, own, hits_.view());
  const HitStream met = search_.surfaces(hits_.view(), caps_);
  for (std::size_t k = 0; k < rays.size; ++k) {
    const Hit hit = hits_.get(k);
    if (hit.t < hits.t[k])
      films_[k] = film_of(get_ray(rays, k), hit, {met.t[k], met.id[k], met.slot[k]}, fog);
  }
}

void GhostFilms::add(Color* radiance) const {
  for (std::size_t k = 0; k < films_.size(); ++k) {
    const Film& film = films_[k];
    if (film.share > 0) radiance[k] = radiance[k] * (1 - film.share) + film.color * film.share;
  }
}

/// `met`: the hit as the surface that was met.
GhostFilms::Film GhostFilms::film_of(const Ray& ray, const Hit& hit, const Hit& met,
                                     const Fog& fog) const {
  const PreparedScene& ghosts = *scene_.ghosts->scene;
  const Surface surface = find_surface(ghosts, ray, met);
  const MaterialRef ref = ghosts.material_ref(hit);
  const Ghost& ghost = std::get<Ghost>(ghosts.plain_materials[ref.index()]);
  const auto cosine = static_cast<float>(surface.cosine);
  const float slant = ghost.opacity + (1 - ghost.opacity) * cosine;
  const float veil = fog.strength > 0 ? fog.share(depth_of(scene_.camera_view, surface.point)) : 0;
  Film film{slant > 0 ? std::min(ghost.opacity / slant, 1.0F) : 0, veil,
            ref.has_color() ? linear_of(ref.color()) : ghost.color};
  if (veil > 0)
    film.color =
        film.color * (1 - veil) + seen_behind(scene_.background, scene_.backdrop, ray.dir) * veil;
  return film;
}

}  // namespace boule
