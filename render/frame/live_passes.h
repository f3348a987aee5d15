#pragma once

#include <bit>
#include <cstddef>
#include <cstdint>

#include "render/frame/pixel_order.h"
#include "render/frame/pixel_rect.h"

namespace boule {

/// Some of a picture's pixels, spread evenly: the points of a grid, or one of `slices` random
/// subsets.
struct PixelPick {
  int x0 = 0, y0 = 0;        ///< the picture's upper left pixel
  int spacing = 1;           ///< pixels from one point of the grid to the next, a power of two
  std::uint32_t slices = 1;  ///< a power of two
  std::uint32_t slice = 0;   ///< below `slices`

  [[nodiscard]] bool takes(int x, int y) const {
    if ((((x - x0) | (y - y0)) & (spacing - 1)) != 0) return false;
    return slices == 1 || (scatter(static_cast<std::uint32_t>(x), static_cast<std::uint32_t>(y)) &
                           (slices - 1)) == slice;
  }

 private:
  /// 32 random bits of a pixel: two odd factors, then the finalizer of MurmurHash3 (Appleby 2011).
  static std::uint32_t scatter(std::uint32_t x, std::uint32_t y) {
    std::uint32_t h = x * 0x9e3779b1u + y * 0x85ebca77u;
    h = (h ^ (h >> 16)) * 0x85ebca6bu;
    h = (h ^ (h >> 13)) * 0xc2b2ae35u;
    return h ^ (h >> 16);
  }
};

/// One step of a picture that is shown as it grows: each picked pixel gets samples until it has
/// `until` of them.
struct LivePass {
  PixelPick pick{};
  int until = 1;
  double share = 1;  ///< the approximate fraction of all samples that are done after this pass
};

/// The spacing of the first pass in order progressive.
inline constexpr int coarsest_spacing = 16;

/// The passes in which a picture that is shown live grows.
/// - progressive: the first sample of every 16th pixel in every 16th row, then of every 8th, 4th
///   and 2nd, then of all pixels; after that one more sample of all pixels per pass.
/// - frameless: the first sample of a random sixteenth of the pixels, then of another, until every
///   pixel has one; after that one more sample of all pixels per pass (after Bishop, Fuchs,
///   McMillan and Zagier, "Frameless rendering", SIGGRAPH 1994).
/// - rows, tiles: all samples in one pass.
class LivePasses {
 public:
  /// Order progressive: the number of passes until every pixel has its first sample.
  static constexpr std::size_t coarse_passes =
      std::bit_width(static_cast<unsigned>(coarsest_spacing));

  /// For a picture of the pixels in `rect` with `spp` samples each; below 1 counts as 1.
  LivePasses(PixelOrder order, const PixelRect& rect, int spp);

  [[nodiscard]] std::size_t size() const;
  /// Pass i. Precondition: i < size().
  [[nodiscard]] LivePass operator[](std::size_t i) const;

  /// The number of passes at the beginning that may come in any order: each gives other pixels
  /// their first sample.
  [[nodiscard]] std::size_t interchangeable() const;

 private:
  PixelOrder order_;
  PixelRect rect_;
  int spp_;
};

}  // namespace boule
