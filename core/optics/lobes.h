#pragma once

#include "core/math/interval.h"
#include "core/optics/reflectance.h"

namespace boule {

/// The continuation of paths at surfaces, as formulas for doubles and for lanes of them. A surface
/// has up to four lobes: the diffuse one, the highlight around the mirrored view direction, the
/// reflected direction and the refracted one. The probability of a lobe is its fraction of the
/// light that the surface sends on. The materials are those of flatten_for_paths().

/// The kinds of materials, by their lobes.
/// - matte: the diffuse lobe alone
/// - glossy: the diffuse lobe or the highlight, and possibly others
/// - clear: only reflection and refraction
enum class LobeKind { none, matte, glossy, clear };

/// The largest probability with which a path survives Russian roulette: in a scene that absorbs
/// nothing, paths must end as well.
inline constexpr float largest_survival = 0.95F;

/// A random direction in which a path continues.
template <class T>
struct BounceOf {
  Vec3<T> direction;  ///< unit length; undefined if the weight is black
  ColorOf<T> weight;  ///< of light from there: reflectance times cosine over density
  T density;          ///< per solid angle; 0 for the one direction of a mirror or of refraction
  Mask<T> beyond;     ///< the path goes through the surface
};

/// The largest fraction of light that the highlight sends on: Ks.
template <class T>
BOULE_INLINE T highlight_albedo(const CoefficientsOf<T>& m) {
  return m.highlight * T(2.0) / (m.shininess + T(2.0));
}

/// The lobes of a surface. A kind with fewer lobes takes less time; the bits are the same.
template <class T, LobeKind kind>
class LobesOf {
 public:
  using F = Single<T>;

  /// Both must outlive it.
  BOULE_INLINE LobesOf(const CoefficientsOf<T>& material, const IncidenceOf<T>& met)
      : material_(material),
        met_(met),
        diffuse_(0.0),
        highlight_(0.0),
        reflection_(0.0),
        refraction_(0.0) {
    if constexpr (kind != LobeKind::clear) diffuse_ = mean_of<T>(material.diffuse);
    if constexpr (kind == LobeKind::glossy) highlight_ = highlight_albedo(material);
    sum_ = diffuse_ + highlight_;
    if constexpr (kind != LobeKind::matte) {
      const Mask<F> dull = is_black_in<T>(material.mirror) & is_black_in<T>(material.transmission);
      is_sharp_ = any(complement(dull));
      if (is_sharp_) {
        weights_ = scatter(material, met);
        reflection_ = mean_of<T>(weights_.reflection);
        refraction_ = mean_of<T>(weights_.refraction);
        sum_ = sum_ + reflection_ + refraction_;
      }
    }
    if constexpr (kind != LobeKind::clear) share_ = T(1.0) / sum_;
  }

  /// Whether the surface sends light on.
  [[nodiscard]] BOULE_INLINE Mask<T> shine() const { return T(0.0) < sum_; }

  /// The response of the diffuse lobe and the highlight to light from a direction.
  struct Response {
    T density;             ///< of choosing the direction by these two lobes
    ColorOf<T> reflected;  ///< the reflectance times n.l times pi
  };

  /// Precondition: `cosine`, which is n.l, is above 0.
  [[nodiscard]] BOULE_INLINE Response respond(const T& cosine, const Vec3<T>& to_light) const {
    T density = diffuse_ * cosine_density(cosine), power(0.0);
    if constexpr (kind == LobeKind::glossy) {
      power = boule::highlight_power(material_, met_.mirrored, to_light);
      density = density + highlight_ * power_density(power, material_.shininess);
    }
    const ColorOf<T> white{F(1.0F), F(1.0F), F(1.0F)};
    return {density * share_, reflected_light(material_, cosine, power, narrow(cosine), white)};
  }

  /// Chooses a lobe, and a direction in it, by two numbers in [0, 1).
  [[nodiscard]] BOULE_INLINE BounceOf<T> bounce(const UnitPairOf<T>& numbers) const {
    const T u = numbers.u * sum_;
    if constexpr (kind == LobeKind::matte) {
      const AngleOf<T> from = warp_to_cosine(rescale<T>(u, {T(0.0), diffuse_}));
      return {direction_about(met_.normal, from, numbers.v), material_.diffuse,
              cosine_density(from.cosine), T(1.0) < T(0.0)};
    } else if constexpr (kind == LobeKind::clear) {
      return straight(u, T(0.0));
    } else {
      return glossy(u, numbers.v);
    }
  }

 private:
  [[nodiscard]] BOULE_INLINE BounceOf<T> glossy(const T& u, const T& turns) const {
    const T both = diffuse_ + highlight_;
    const Mask<T> diffuse = u < diffuse_, scatters = u < both, shiny = scatters & (diffuse_ <= u);
    AngleOf<T> from = warp_to_cosine(rescale<T>(u, {T(0.0), diffuse_}));
    if (any(shiny)) {
      const AngleOf<T> about =
          warp_to_power(rescale<T>(u, {diffuse_, highlight_}), material_.shininess);
      from = {select(shiny, about.cosine, from.cosine), select(shiny, about.sine, from.sine)};
    }
    const Vec3<T> direction =
        direction_about(select(shiny, met_.mirrored, met_.normal), from, turns);
    const Mask<T> alone = diffuse & (sum_ <= diffuse_);
    BounceOf<T> spread = scattered(direction);
    if (any(alone)) {
      spread.weight = select(narrow(alone), material_.diffuse, spread.weight);
      spread.density = select(alone, cosine_density(from.cosine), spread.density);
    }
    if (!is_sharp_) return spread;
    const BounceOf<T> sharp = straight(u, both);
    return {select(scatters, direction, sharp.direction),
            select(narrow(scatters), spread.weight, sharp.weight),
            select(scatters, spread.density, T(0.0)),
            select(scatters, T(1.0) < T(0.0), sharp.beyond)};
  }

  /// The bounce into a direction of the diffuse lobe or the highlight, which counts for both.
  [[nodiscard]] BOULE_INLINE BounceOf<T> scattered(const Vec3<T>& direction) const {
    const T cosine = dot(met_.normal, direction);
    const Response response = respond(cosine, direction);
    const Mask<T> counts = (T(0.0) < cosine) & (T(0.0) < response.density);
    const F scale = narrow(T(1.0) / (T(elementary::pi) * response.density));
    const ColorOf<T> black{F(0.0F), F(0.0F), F(0.0F)};
    return {direction, select(narrow(counts), response.reflected * scale, black), response.density,
            T(1.0) < T(0.0)};
  }

  /// Into the reflected or the refracted direction; `first` is the sum of the shares of the lobes
  /// before.
  [[nodiscard]] BOULE_INLINE BounceOf<T> straight(const T& u, const T& first) const {
    const Mask<T> goes_back = (u < first + reflection_) | complement(T(0.0) < refraction_);
    const ColorOf<T> back = weights_.reflection * narrow(sum_ / reflection_);
    const ColorOf<T> on = weights_.refraction * narrow(sum_ / refraction_);
    const ColorOf<T> black{F(0.0F), F(0.0F), F(0.0F)};
    const ColorOf<T> reflected = select(narrow(T(0.0) < reflection_), back, black);
    return {select(goes_back, met_.mirrored, weights_.refracted),
            select(narrow(goes_back), reflected, on), T(0.0), complement(goes_back)};
  }

  const CoefficientsOf<T>& material_;
  const IncidenceOf<T>& met_;
  ScatterOf<T> weights_;
  T diffuse_, highlight_, reflection_, refraction_;  ///< the light that each lobe sends on
  T sum_, share_;                                    ///< of all lobes, and 1 / sum_
  bool is_sharp_ = false;                            ///< some lane reflects or refracts
};

/// Veach's power heuristic with exponent 2 ("Robust Monte Carlo methods for light transport
/// simulation", 1997, 9.2): the weight of a sample with density a, where the other strategy would
/// have chosen it with density b.
template <class T>
BOULE_INLINE T power_heuristic(const T& a, const T& b) {
  const T ratio = b / a;
  return T(1.0) / (T(1.0) + ratio * ratio);
}

/// The colour of a gradient from `bottom` to `top` in a direction with this cosine to up.
template <class T>
BOULE_INLINE ColorOf<T> gradient_color(const ColorOf<T>& bottom, const ColorOf<T>& top,
                                       const T& cosine) {
  // Clamped, because rounding could push it out of 0..1, and a colour below 0.
  const T height = (T(1.0) + cosine) / T(2.0);
  const T held = select(height < T(0.0), T(0.0), select(T(1.0) < height, T(1.0), height));
  const Single<T> share = narrow(held);
  return bottom * (Single<T>(1.0F) - share) + top * share;
}

}  // namespace boule
