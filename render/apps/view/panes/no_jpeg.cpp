#include "render/apps/view/panes/jpeg.h"

/// In place of jpeg.cpp where there is no libjpeg-turbo.
namespace boule::view {

struct JpegEncoder::Compressor {};

bool has_jpeg() { return false; }
JpegEncoder::JpegEncoder() = default;
JpegEncoder::~JpegEncoder() = default;
std::string JpegEncoder::encode(const Image&, float, int) { return {}; }

}  // namespace boule::view
