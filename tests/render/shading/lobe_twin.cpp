#include "tests/render/shading/lobe_twin.h"

#include <algorithm>
#include <cmath>

#include "core/math/elementary.h"
#include "core/math/random.h"
#include "core/math/warp.h"

namespace boule::test {
namespace {

double rescale(double u, double first, double size) {
  return std::clamp((u - first) / size, 0.0, below_one);
}

double power(double base, double exponent) {
  constexpr double largest = 1024;
  const auto whole = static_cast<int>(std::min(exponent, largest));
  if (exponent != whole) return elementary::pow_for_float(base, exponent);
  double result = 1;
  for (int n = whole; n > 0; n /= 2) {
    if (n % 2 == 1) result *= base;
    base *= base;
  }
  return result;
}

struct Bent {
  Vec3d direction;
  double cosine = 0;
  bool total = true;
};

Bent bend(const Vec3d& view, const Vec3d& normal, double cosine, double eta) {
  const double sine_squared = eta * eta * (1 - cosine * cosine);
  if (sine_squared >= 1) return {};
  const double beyond = std::sqrt(1 - sine_squared);
  return {view * eta + normal * (eta * cosine - beyond), beyond, false};
}

double reflected_share(double cosine, const Bent& bent, double eta) {
  const double s = (eta * cosine - bent.cosine) / (eta * cosine + bent.cosine);
  const double p = (eta * bent.cosine - cosine) / (eta * bent.cosine + cosine);
  return 0.5 * (s * s + p * p);
}

double mean(const Color& c) { return component_sum(c) * (1.0 / 3); }

}  // namespace

Scatter scatter_twin(const FlatMaterial& material, const Surface& surface) {
  if (is_black(material.transmission) && !material.fresnel) return {material.mirror, {}, {}};
  const double eta = surface.inner ? material.ior : 1 / material.ior;
  const Bent bent = bend(surface.view, surface.normal, surface.cosine, eta);
  if (material.fresnel) {
    if (bent.total) return {material.mirror, {}, {}};
    const double reflected = reflected_share(surface.cosine, bent, eta);
    return {material.mirror * static_cast<float>(reflected),
            material.transmission * static_cast<float>(1 - reflected), bent.direction};
  }
  if (bent.total) return {material.mirror + material.transmission, {}, {}};
  return {material.mirror, material.transmission, bent.direction};
}

LobeSampler::LobeSampler(const FlatMaterial& material, const Surface& surface)
    : material_(&material),
      normal_(surface.normal),
      mirrored_(surface.mirrored),
      diffuse_(mean(material.diffuse)),
      highlight_(highlight_albedo(material)),
      reflection_(0),
      refraction_(0) {
  if (scatters(material)) {
    weights_ = scatter_twin(material, surface);
    reflection_ = mean(weights_.reflection);
    refraction_ = mean(weights_.refraction);
  }
  sum_ = diffuse_ + highlight_ + reflection_ + refraction_;
}

Color LobeSampler::reflected(double cosine, const Vec3d& to_light) const {
  const Color sum = material_->diffuse * static_cast<float>(cosine);
  if (!(material_->highlight > 0)) return sum;
  const double r_dot_l = std::min(dot(mirrored_, to_light), 1.0);
  if (!(r_dot_l > 0)) return sum;
  const double highlight = material_->highlight * power(r_dot_l, material_->shininess);
  return sum + gray(static_cast<float>(highlight) * static_cast<float>(cosine));
}

double LobeSampler::density(double cosine, const Vec3d& to_light) const {
  double density = diffuse_ * cosine_density(cosine);
  if (highlight_ > 0) {
    const double r_dot_l = std::min(dot(mirrored_, to_light), 1.0);
    if (r_dot_l > 0) {
      density +=
          highlight_ * power_density(power(r_dot_l, material_->shininess), material_->shininess);
    }
  }
  return density * (1 / sum_);
}

LobeSampler::Choice LobeSampler::choose(UnitPair numbers) const {
  const double u = numbers.u * sum_;
  double first = 0;
  if (u < first + diffuse_) {
    return {Lobe::diffuse, warp_to_cosine(rescale(u, first, diffuse_)), numbers.v};
  }
  first += diffuse_;
  if (u < first + highlight_) {
    const double inner = rescale(u, first, highlight_);
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

}  // namespace boule::test
