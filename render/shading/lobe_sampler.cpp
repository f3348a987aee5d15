#include "render/shading/lobe_sampler.h"

#include <algorithm>

#include "core/math/elementary.h"
#include "core/math/warp.h"
#include "render/prepare/interval.h"

namespace boule {
namespace {

double mean(const Color& c) { return component_sum(c) / 3; }

}  // namespace

LobeSampler::LobeSampler(const FlatMaterial& material, const Surface& surface)
    : material_(&material),
      normal_(surface.normal),
      mirrored_(surface.mirrored),
      diffuse_(mean(material.diffuse)),
      highlight_(highlight_albedo(material)),
      reflection_(0),
      refraction_(0) {
  if (scatters(material)) {
    weights_ = scatter(material, surface);
    reflection_ = mean(weights_.reflection);
    refraction_ = mean(weights_.refraction);
  }
  sum_ = diffuse_ + highlight_ + reflection_ + refraction_;
}

double LobeSampler::density(double cosine, const Vec3d& to_light) const {
  double density = diffuse_ * cosine_density(cosine);
  if (highlight_ > 0) {
    const double r_dot_l = std::min(dot(mirrored_, to_light), 1.0);
    if (r_dot_l > 0) {
      density +=
          highlight_ * power_density(highlight_power(*material_, r_dot_l), material_->shininess);
    }
  }
  return density / sum_;
}

LobeSampler::Choice LobeSampler::choose(UnitPair numbers) const {
  const double u = numbers.u * sum_;
  double first = 0;
  if (u < first + diffuse_) {
    return {Lobe::diffuse, warp_to_cosine(rescale(u, {.first = first, .size = diffuse_})),
            numbers.v};
  }
  first += diffuse_;
  if (u < first + highlight_) {
    const double inner = rescale(u, {.first = first, .size = highlight_});
    return {Lobe::highlight, warp_to_power(inner, material_->shininess), numbers.v};
  }
  first += highlight_;
  if (u < first + reflection_ || !(refraction_ > 0)) {
    return {reflection_ > 0 ? Lobe::reflection : Lobe::none};
  }
  return {Lobe::refraction};
}

Bounce LobeSampler::bounce(const Choice& choice, const Vec3d& direction) const {
  switch (choice.lobe) {
    case Lobe::diffuse:
      if (diffuse_ < sum_) return scattered(direction);
      return {direction, Side::viewer, material_->diffuse, cosine_density(choice.from.cosine)};
    case Lobe::highlight:
      return scattered(direction);
    case Lobe::reflection:
      return {mirrored_, Side::viewer,
              weights_.reflection * static_cast<float>(sum_ / reflection_)};
    case Lobe::refraction:
      return {weights_.refracted, Side::beyond,
              weights_.refraction * static_cast<float>(sum_ / refraction_)};
    case Lobe::none:
      break;
  }
  return {};
}

/// The bounce into a direction of the diffuse lobe or the highlight, which counts for both of them.
Bounce LobeSampler::scattered(const Vec3d& direction) const {
  const double cosine = dot(normal_, direction);
  if (!(cosine > 0)) return {};
  const double density = this->density(cosine, direction);
  if (!(density > 0)) return {};
  const auto scale = static_cast<float>(1 / (elementary::pi * density));
  return {direction, Side::viewer, reflected(cosine, direction) * scale, density};
}

}  // namespace boule
