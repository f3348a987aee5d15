#pragma once

#include <string>

#include "render/image/image_format.h"

namespace boule {

/// The damage of a file, or an empty text. It looks at a JPEG file's markers, a PNG file's
/// checksums and an EXR file's headers, because libjpeg invents missing data, libpng complains on
/// standard error, and OpenEXR fills memory. Files of other formats are left to their readers. So
/// are PNG files with correct checksums over nonsense.
std::string file_damage(const std::string& path, const ImageFormat& format);

}  // namespace boule
