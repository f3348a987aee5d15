#include "render/apps/view/panes/jpeg.h"

#include <turbojpeg.h>

#include "render/image/tone.h"

namespace boule::view {

bool has_jpeg() { return true; }

struct JpegEncoder::Compressor {
  tjhandle handle = tjInitCompress();
  unsigned char* bytes = nullptr;
  unsigned long size = 0;

  Compressor() = default;
  ~Compressor() {
    tjFree(bytes);
    if (handle != nullptr) tjDestroy(handle);
  }
  Compressor(const Compressor&) = delete;
  Compressor& operator=(const Compressor&) = delete;
};

JpegEncoder::JpegEncoder() : compressor_(std::make_unique<Compressor>()) {}
JpegEncoder::~JpegEncoder() = default;

std::string JpegEncoder::encode(const Image& image, float exposure_stops, int quality) {
  Image opaque;
  if (!image.alpha.empty()) {
    opaque = image;
    opaque.alpha.clear();
  }
  const auto pixels = tone_map(image.alpha.empty() ? image : opaque, exposure_stops);
  Compressor& to = *compressor_;
  const bool made = to.handle != nullptr &&
                    tjCompress2(to.handle, pixels.data(), image.width, 0, image.height, TJPF_RGB,
                                &to.bytes, &to.size, TJSAMP_444, quality, TJFLAG_FASTDCT) == 0;
  if (!made) return {};
  return {reinterpret_cast<const char*>(to.bytes), to.size};
}

}  // namespace boule::view
