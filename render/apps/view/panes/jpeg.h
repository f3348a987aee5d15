#pragma once

#include <memory>
#include <string>

#include "render/image/image.h"

namespace boule::view {

/// Whether this build makes JPEG pictures (libjpeg-turbo).
bool has_jpeg();

/// Makes JPEG pictures. It keeps its working memory from one to the next.
class JpegEncoder {
 public:
  JpegEncoder();
  ~JpegEncoder();
  JpegEncoder(const JpegEncoder&) = delete;
  JpegEncoder& operator=(const JpegEncoder&) = delete;

  /// The picture by tone_map() with this exposure, its alpha left out, at a quality of 1 to 100.
  /// Empty where it cannot be made. Precondition: has_jpeg().
  std::string encode(const Image& image, float exposure_stops, int quality);

 private:
  struct Compressor;

  std::unique_ptr<Compressor> compressor_;
};

}  // namespace boule::view
