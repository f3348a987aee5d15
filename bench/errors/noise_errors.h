#pragma once

#include <vector>

#include "core/scene/scene.h"

namespace boule::bench {

/// A picture, and its distance from the reference. Errors are differences of pixels in displayed
/// values (sRGB-coded, 0..1), of the channel where they are greatest.
struct NoiseError {
  double asked = 0;         ///< the noise, or the number of samples of all pixels
  double mean_samples = 0;  ///< of a pixel
  double seconds = 0;       ///< processor time of one thread, without preparation
  double mrays = 0;         ///< million rays
  double rms = 0;           ///< root of the mean square of all pixels' errors
  double within_95 = 0;     ///< 95 % of the pixels have at most this error
  double within_99 = 0;
};

/// Pictures of one scene, ascending in samples.
struct NoiseErrors {
  std::vector<NoiseError> uniform;   ///< all pixels have as many samples, of a sequence each
  std::vector<NoiseError> random;    ///< all have as many, each drawn by itself
  std::vector<NoiseError> to_order;  ///< as many as a pixel needs for the noise that is asked for
};

struct NoiseSettings {
  int width = 192, height = 108;
  int reference = 4096;  ///< samples of the reference, 256 at least, which has another seed
  unsigned threads = 1;  ///< of the reference; what is timed has one
};

/// Pictures with 16, 32 ... samples, up to a 16th of the reference's, and with noise of 0.16, 0.08
/// ... 0.02 and at most an eighth of the reference's samples in a pixel, all by the scene's own
/// method. What is timed is rendering into memory. Precondition: the scene and the settings are
/// valid.
NoiseErrors measure_noise_errors(const Scene& scene, const NoiseSettings& settings);

/// The seconds that pictures of `errors` need until 99 % of the pixels are within `error`, between
/// neighbours on logarithmic axes; beyond the last one as if the error fell with the root of time,
/// and no less than the first one's.
/// Preconditions: `errors` is not empty; error > 0.
double seconds_until(double error, const std::vector<NoiseError>& errors);

}  // namespace boule::bench
