#pragma once

#include <string>

#include "core/base/error.h"
#include "render/image/image.h"

namespace boule::bench {

/// How a file's 8-bit numbers encode light.
enum class Curve { linear, srgb };

/// A picture read from a file, as linear colours.
Result<Image> read_picture(const std::string& path, Curve curve);

/// How far two programs' pictures of one scene differ.
struct Difference {
  double mean = 0;   ///< of |a - b|, over pixels and channels
  double share = 0;  ///< of pixels that differ by more than 0.1 in a channel
};

/// How far `theirs` is from `ours`, both clamped to 0..1. `habit` is a colour that the other
/// program adds to some pixels by design: it is subtracted where that brings a pixel nearer to
/// ours.
Difference compare_pictures(const Image& ours, const Image& theirs, const Color& habit);

/// The most two pictures of one scene may differ.
struct Tolerance {
  double mean, share;
};

inline bool within(const Difference& difference, const Tolerance& tolerance) {
  return difference.mean <= tolerance.mean && difference.share <= tolerance.share;
}

}  // namespace boule::bench
