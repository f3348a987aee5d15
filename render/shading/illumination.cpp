#include "render/shading/illumination.h"

#include <algorithm>
#include <bit>

#include "core/math/geometry.h"
#include "render/shading/bsdf.h"
#include "render/shading/lights.h"

namespace boule {
namespace {

/// So many points' directions to a light stay in registers and the first cache.
constexpr std::size_t batch = 64;

/// Where a light is for a batch of points, and n.l.
struct Directions {
  double x[batch], y[batch], z[batch], cosine[batch];
};

}  // namespace

void Illumination::Vectors::resize(std::size_t size) {
  x.resize(size);
  y.resize(size);
  z.resize(size);
}

void Illumination::Vectors::set(std::size_t i, const Vec3d& v) {
  x[i] = v.x;
  y[i] = v.y;
  z[i] = v.z;
}

void Illumination::start(std::size_t rays) {
  size_ = 0;
  const std::size_t room = std::bit_ceil(rays);
  for (Vectors* vectors : {&points_, &normals_, &mirrored_, &orgs_}) vectors->resize(room);
  shadow_rays_.resize(room);
  if (origins_.size() >= room) return;
  origins_.resize(room);
  arrivals_.resize(room);
}

void Illumination::add_point(std::uint32_t ray, const FlatMaterial& material,
                             const Surface& surface) {
  const Departure departure = depart(surface, Side::viewer);
  points_.set(size_, surface.point);
  normals_.set(size_, surface.normal);
  mirrored_.set(size_, surface.mirrored);
  orgs_.set(size_, departure.org);
  origins_[size_] = {&material, ray, departure.source, departure.inside};
  ++size_;
}

/// The light by value: nothing that is stored can change it.
template <class AnyLight>
std::size_t Illumination::aim_at(AnyLight light) {
  const double* const px = points_.x.data();
  const double* const py = points_.y.data();
  const double* const pz = points_.z.data();
  const double* const nx = normals_.x.data();
  const double* const ny = normals_.y.data();
  const double* const nz = normals_.z.data();
  std::size_t aimed = 0;
  for (std::size_t first = 0; first < size_; first += batch) {
    const std::size_t count = std::min(batch, size_ - first);
    Directions to;
    for (std::size_t k = 0; k < count; ++k) {  // GCC makes packets of it
      const std::size_t i = first + k;
      const Vec3d to_light = direction_to(light, {px[i], py[i], pz[i]});
      to.x[k] = to_light.x;
      to.y[k] = to_light.y;
      to.z[k] = to_light.z;
      to.cosine[k] = dot(Vec3d{nx[i], ny[i], nz[i]}, to_light);
    }
    for (std::size_t k = 0; k < count; ++k) {
      // Written in any case, kept where the point faces the light: no branch to foretell.
      const std::size_t i = first + k;
      const Origin& origin = origins_[i];
      const Departure departure{orgs_.get(i), origin.source, origin.inside};
      arrivals_[aimed] = {{to.x[k], to.y[k], to.z[k]}, to.cosine[k], i};
      shadow_rays_.set(aimed, from_surface(way_to(light, departure.org), departure));
      aimed += to.cosine[k] > 0 ? 1 : 0;
    }
  }
  return aimed;
}

RayStream Illumination::aim(const Light& light) {
  aimed_ = std::visit([this](const auto& any) { return aim_at(any); }, light);
  RayStream rays = shadow_rays_.view();
  rays.size = aimed_;
  return rays;
}

template <class AnyLight>
void Illumination::add_light(const AnyLight& light, const std::uint8_t* blocked,
                             Color* radiance) const {
  for (std::size_t k = 0; k < aimed_; ++k) {
    if (blocked[k] != 0) continue;
    const auto& [to_light, cosine, point] = arrivals_[k];
    const Origin& origin = origins_[point];
    const Color intensity = intensity_at(light, points_.get(point));
    Color& sum = radiance[origin.ray];
    sum = sum + direct_light(*origin.material, cosine, to_light, mirrored_.get(point), intensity);
  }
}

void Illumination::add_unblocked(const Light& light, const std::uint8_t* blocked,
                                 Color* radiance) const {
  std::visit([&](const auto& any) { add_light(any, blocked, radiance); }, light);
}

}  // namespace boule
