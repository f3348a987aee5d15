#pragma once

#include <string>

#include "render/image/image_format.h"

namespace boule {

/// False if a JPEG or PNG file has lost its end, as its own marks tell: libjpeg makes up what is
/// missing, and libpng complains on standard error. Other files are left to their readers.
bool is_whole_file(const std::string& path, const ImageFormat& format);

}  // namespace boule
