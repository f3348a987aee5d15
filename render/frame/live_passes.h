#pragma once

#include <cstddef>
#include <cstdint>

#include "render/frame/pixel_order.h"
#include "render/frame/pixel_rect.h"

namespace boule {

/// Some of a picture's pixels, evenly spread: those of a grid, or one of `slices` random shares.
struct PixelPick {
  int x0 = 0, y0 = 0;        ///< the picture's upper left pixel
  int spacing = 1;           ///< of the grid, a power of two
  std::uint32_t slices = 1;  ///< a power of two
  std::uint32_t slice = 0;   ///< below `slices`

  [[nodiscard]] bool takes(int x, int y) const {
    if ((((x - x0) | (y - y0)) & (spacing - 1)) != 0) return false;
    return slices == 1 || (scatter(static_cast<std::uint32_t>(x), static_cast<std::uint32_t>(y)) &
                           (slices - 1)) == slice;
  }

 private:
  /// A pixel's 32 random bits: the finalizer of MurmurHash3 (Appleby 2011) after two odd factors.
  static std::uint32_t scatter(std::uint32_t x, std::uint32_t y) {
    std::uint32_t h = x * 0x9e3779b1u + y * 0x85ebca77u;
    h = (h ^ (h >> 16)) * 0x85ebca6bu;
    h = (h ^ (h >> 13)) * 0xc2b2ae35u;
    return h ^ (h >> 16);
  }
};

/// One step of a picture in the making: its pixels get samples until they have `until`.
struct LivePass {
  PixelPick pick;
  int until = 1;
  double share = 1;  ///< of all samples that are done after it, about
};

/// Spacing of the first pixels in order progressive.
inline constexpr int coarsest_spacing = 16;

/// The steps in which a picture grows while somebody watches. progressive: the first sample of
/// every 16th pixel of every 16th row, of every 8th, 4th, 2nd, of all; then sample by sample.
/// frameless: the first sample of a random sixteenth of the pixels, of the next, until all have
/// one; then sample by sample (after Bishop, Fuchs, McMillan and Zagier, "Frameless rendering",
/// SIGGRAPH 1994). rows, tiles: all samples in one step.
class LivePasses {
 public:
  /// A picture of the pixels in `rect`, `spp` samples each; below 1 counts as 1.
  LivePasses(PixelOrder order, const PixelRect& rect, int spp);

  [[nodiscard]] std::size_t size() const;
  /// Pass i < size(): precondition.
  [[nodiscard]] LivePass operator[](std::size_t i) const;

 private:
  PixelOrder order_;
  PixelRect rect_;
  int spp_;
};

}  // namespace boule
