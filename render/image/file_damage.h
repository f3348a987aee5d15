#pragma once

#include <string>

#include "render/image/image_format.h"

namespace boule {

/// What a JPEG or PNG file's own marks and checksums, or the headers of an EXR file, tell to be
/// wrong with it: libjpeg makes up what is missing, libpng complains on standard error, OpenEXR
/// fills memory. Empty where they tell nothing; other files are left to their readers, and so are
/// PNG files that a writer has filled with nonsense and true checksums.
std::string file_damage(const std::string& path, const ImageFormat& format);

}  // namespace boule
