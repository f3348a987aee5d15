#include "render/image/image_format.h"

#include <filesystem>

#include "core/base/text.h"

namespace boule {
namespace {

/// JPEG keeps all texts in one segment of less than 64 KiB; libjpeg ends the process beyond that.
constexpr int jpeg_segment = 60'000;

// hdr stores colours with a shared exponent (RGBE). TIFF has 8 bits, as viewers and office programs
// expect; for floats there is EXR.
constexpr ImageFormat formats[] = {
    {.extension = "exr",
     .writer = "openexr",
     .alpha = true,
     .hdr = true,
     .channels = true,
     .remarks = true},
    {.extension = "hdr", .writer = "hdr", .hdr = true},
    {.extension = "rgbe", .writer = "hdr", .hdr = true},
    {.extension = "png", .writer = "png", .alpha = true, .remarks = true},
    {.extension = "jpg",
     .writer = "jpeg",
     .longest_side = 65500,
     .text_room = jpeg_segment,
     .remarks = true},
    {.extension = "jpeg",
     .writer = "jpeg",
     .longest_side = 65500,
     .text_room = jpeg_segment,
     .remarks = true},
    {.extension = "jpe",
     .writer = "jpeg",
     .longest_side = 65500,
     .text_room = jpeg_segment,
     .remarks = true},
    {.extension = "tif", .writer = "tiff", .remarks = true},
    {.extension = "tiff", .writer = "tiff", .remarks = true},
    {.extension = "webp", .writer = "webp", .longest_side = 16383},
    {.extension = "ppm", .writer = "pnm"},
    {.extension = "pnm", .writer = "pnm"},
    {.extension = "bmp", .writer = "bmp"},
    {.extension = "tga", .writer = "targa", .longest_side = 65535, .remarks = true},
};

}  // namespace

const ImageFormat* find_image_format(const std::string& path) {
  std::string extension = std::filesystem::path(path).extension().string();
  if (extension.size() < 2) return nullptr;
  extension.erase(0, 1);
  for (char& c : extension) c = ascii_lower(c);
  for (const ImageFormat& format : formats) {
    if (extension == format.extension) return &format;
  }
  return nullptr;
}

std::string known_image_extensions() {
  std::string names;
  for (const ImageFormat& format : formats) {
    if (!names.empty()) names += ", ";
    names += format.extension;
  }
  return names;
}

std::string unknown_image_extension() {
  return "unknown image extension, expected one of " + known_image_extensions();
}

}  // namespace boule
