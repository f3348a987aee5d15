#include "render/image/image_format.h"

#include <filesystem>
#include <limits>

namespace boule {
namespace {

constexpr int any = std::numeric_limits<int>::max();

/// Room for all texts of a file, in bytes. JPEG keeps them in one segment of less than 64 KiB.
/// Other formats have no limit; this one is far above any remark.
constexpr int segment = 60'000, ample = 1 << 24;

// hdr stores colours with a shared exponent (RGBE). TIFF has 8 bits, as viewers and office programs
// expect; for floats there is EXR.

constexpr ImageFormat formats[] = {
    {"exr", "openexr", any, ample, true, true, true},
    {"hdr", "hdr", any, ample, true, false, false},
    {"rgbe", "hdr", any, ample, true, false, false},
    {"png", "png", any, ample, false, false, true},
    {"jpg", "jpeg", 65500, segment, false, false, true},
    {"jpeg", "jpeg", 65500, segment, false, false, true},
    {"jpe", "jpeg", 65500, segment, false, false, true},
    {"tif", "tiff", any, ample, false, false, true},
    {"tiff", "tiff", any, ample, false, false, true},
    {"webp", "webp", 16383, ample, false, false, false},
    {"ppm", "pnm", any, ample, false, false, false},
    {"pnm", "pnm", any, ample, false, false, false},
    {"bmp", "bmp", any, ample, false, false, false},
    {"tga", "targa", 65535, ample, false, false, true},
};

char lower(char c) { return c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c; }

}  // namespace

const ImageFormat* find_image_format(const std::string& path) {
  std::string extension = std::filesystem::path(path).extension().string();
  if (extension.size() < 2) return nullptr;
  extension.erase(0, 1);
  for (char& c : extension) c = lower(c);
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
