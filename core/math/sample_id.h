#pragma once

namespace boule {

/// One sample of a pixel of the frame. Its random numbers depend on this and on the picture's seed.
struct SampleId {
  int x, y;  ///< the pixel
  int sample;
};

}  // namespace boule
