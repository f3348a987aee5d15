#pragma once

#include <cstdint>
#include <type_traits>

#include "core/math/srgb.h"

namespace boule {

/// The material of a primitive, in 32 bits: the index of a material in Scene::materials and, if the
/// primitive has a colour of its own, that colour, which replaces the material's. So a colour costs
/// a sphere no memory.
class MaterialRef {
 public:
  /// The number of materials, the first ones of a scene, that can be given a colour: those with an
  /// index below this.
  static constexpr std::uint32_t max_colored = 128;

  /// A material in its own colour. Precondition: index < 2^31.
  template <class Index>
  requires std::is_integral_v<Index>
  constexpr MaterialRef(Index index) : bits_(static_cast<std::uint32_t>(index)) {}
  constexpr MaterialRef() = default;

  /// A material in another colour. Precondition: index < max_colored.
  static constexpr MaterialRef colored(std::uint32_t index, SrgbColor color) {
    MaterialRef ref;
    ref.bits_ = color_bit | index << 24 | std::uint32_t{color.r} << 16 |
                std::uint32_t{color.g} << 8 | color.b;
    return ref;
  }

  [[nodiscard]] constexpr std::uint32_t index() const {
    return has_color() ? (bits_ & ~color_bit) >> 24 : bits_;
  }
  [[nodiscard]] constexpr bool has_color() const { return (bits_ & color_bit) != 0; }
  /// The colour. Precondition: it has one.
  [[nodiscard]] constexpr SrgbColor color() const {
    return {static_cast<std::uint8_t>(bits_ >> 16), static_cast<std::uint8_t>(bits_ >> 8),
            static_cast<std::uint8_t>(bits_)};
  }
  /// All of it as one number, unique to this MaterialRef.
  [[nodiscard]] constexpr std::uint32_t bits() const { return bits_; }

 private:
  static constexpr std::uint32_t color_bit = 0x80000000U;

  std::uint32_t bits_ = 0;
};
constexpr bool operator==(const MaterialRef& a, const MaterialRef& b) {
  return a.bits() == b.bits();
}

}  // namespace boule
