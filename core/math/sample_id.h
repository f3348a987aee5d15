#pragma once

namespace boule {

/// One sample of a pixel of the frame. Its random numbers depend on this and on the picture's seed.
struct SampleId {
  int x = 0, y = 0;  ///< the pixel
  int sample = 0;
};

}  // namespace boule
