#include "render/image/tone.h"

#include <algorithm>
#include <array>
#include <bit>
#include <limits>

#include "core/base/float_environment.h"
#include "core/math/elementary.h"

namespace boule {
namespace {

/// A table by which a code is found without computing a power per sample. The upper 16 bits of a
/// float below 1 choose a bucket, whose relative width is 2^-7. Any two steps from code to code are
/// further apart than that, so a bucket holds at most one step, and one comparison decides.
class SrgbTable {
 public:
  SrgbTable() {
    const FloatEnvironment environment;  // the table serves later calls, too
    step_[0] = 0;
    step_[256] = std::numeric_limits<float>::infinity();
    for (int code = 1; code < 256; ++code) step_[static_cast<std::size_t>(code)] = first(code);
    for (std::size_t bucket = 0; bucket < buckets; ++bucket) {
      const float low = std::bit_cast<float>(static_cast<std::uint32_t>(bucket) << 16);
      const auto above = std::upper_bound(step_.begin(), step_.end(), low);
      base_[bucket] = static_cast<std::uint8_t>(above - step_.begin() - 1);
    }
  }

  [[nodiscard]] std::uint8_t code(float v) const {
    if (!(v > 0)) return 0;
    if (v >= 1) return 255;
    const std::size_t base = base_[std::bit_cast<std::uint32_t>(v) >> 16];
    return static_cast<std::uint8_t>(base + (v >= step_[base + 1] ? 1U : 0U));
  }

 private:
  static constexpr std::size_t buckets = 0x3f80;  // the upper half of 1.0f

  /// The least float whose code is at least this one.
  static float first(int code) {
    const double v = linear_from_srgb((code - 0.5) / 255);
    const auto nearest = static_cast<float>(v);
    if (static_cast<double>(nearest) >= v) return nearest;
    return std::bit_cast<float>(std::bit_cast<std::uint32_t>(nearest) + 1);
  }

  std::array<float, 257> step_{};  // step_[c]: the least float of code c
  std::array<std::uint8_t, buckets> base_{};
};

const SrgbTable& srgb_table() {
  static const SrgbTable table;
  return table;
}

float exposure_scale(float stops) {
  const float bounded = stops != stops ? 0 : std::clamp(stops, -126.0F, 126.0F);
  return static_cast<float>(elementary::pow(2, static_cast<double>(bounded)));
}

}  // namespace

double linear_from_srgb(double s) {
  return s <= 0.04045 ? s / 12.92 : elementary::pow((s + 0.055) / 1.055, 2.4);
}

std::vector<std::uint8_t> tone_map(const Image& image, float stops) {
  const FloatEnvironment environment;
  const SrgbTable& table = srgb_table();
  const float scale = exposure_scale(stops);
  std::vector<std::uint8_t> codes(image.pixels.size() * 3);
  std::uint8_t* out = codes.data();
  for (const Color& color : image.pixels) {
    *out++ = table.code(color.r * scale);
    *out++ = table.code(color.g * scale);
    *out++ = table.code(color.b * scale);
  }
  return codes;
}

}  // namespace boule
