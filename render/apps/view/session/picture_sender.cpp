#include "render/apps/view/session/picture_sender.h"

#include "render/image/encode_image.h"

namespace boule::view {

std::string png_of(const Image& image, float exposure_stops) {
  ImageFileOptions options;
  options.exposure_stops = exposure_stops;
  auto bytes = encode_image(image, StreamFormat::png, "the picture", options);
  return bytes ? std::move(bytes).value() : std::string();
}

void PictureSender::send(const Image& image, FrameHeader header, float exposure_stops) {
  constexpr int quality_moving = 80, quality_still = 92;
  header.width = image.width;
  header.height = image.height;
  header.finished = false;
  if (has_jpeg()) {
    header.code = PictureCode::jpeg;
    const int quality = header.moving ? quality_moving : quality_still;
    const std::string bytes = jpeg_.encode(image, exposure_stops, quality);
    if (!bytes.empty()) audience_.add_frame(header, bytes);
    return;
  }
  header.code = PictureCode::png;
  const std::string bytes = png_of(image, exposure_stops);
  if (!bytes.empty()) audience_.add_frame(header, bytes);
}

bool PictureSender::send_finished(const Image& image, FrameHeader header, float exposure_stops) {
  header.width = image.width;
  header.height = image.height;
  header.finished = true;
  header.code = PictureCode::png;
  const std::string bytes = png_of(image, exposure_stops);
  if (!bytes.empty()) audience_.add_frame(header, bytes);
  return !bytes.empty();
}

}  // namespace boule::view
