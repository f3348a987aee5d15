#pragma once

#include <string>

#include "render/image/image_format.h"

namespace boule {

/// False if a JPEG or PNG file has lost its end, or an EXR file that of its headers, as their own
/// marks tell: libjpeg makes up what is missing, libpng complains on standard error, OpenEXR fills
/// memory. Other files are left to their readers; so is what is wrong within a PNG, of which libpng
/// tells standard error a line that OpenImageIO lets pass.
bool is_whole_file(const std::string& path, const ImageFormat& format);

}  // namespace boule
