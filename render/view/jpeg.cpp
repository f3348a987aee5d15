#include "render/view/jpeg.h"

#include <turbojpeg.h>

#include "render/image/tone.h"

namespace boule::view {

bool has_jpeg() { return true; }

JpegEncoder::JpegEncoder() : compressor_(tjInitCompress()) {}

JpegEncoder::~JpegEncoder() {
  tjFree(bytes_);
  if (compressor_ != nullptr) tjDestroy(compressor_);
}

std::string JpegEncoder::encode(const Image& image, float exposure_stops, int quality) {
  Image opaque;
  if (!image.alpha.empty()) {
    opaque = image;
    opaque.alpha.clear();
  }
  const auto pixels = tone_map(image.alpha.empty() ? image : opaque, exposure_stops);
  const bool made =
      compressor_ != nullptr &&
      tjCompress2(compressor_, pixels.data(), image.width, 0, image.height, TJPF_RGB, &bytes_,
                  &room_, quality >= 90 ? TJSAMP_444 : TJSAMP_420, quality, TJFLAG_FASTDCT) == 0;
  if (!made) return {};
  return {reinterpret_cast<const char*>(bytes_), room_};
}

}  // namespace boule::view
