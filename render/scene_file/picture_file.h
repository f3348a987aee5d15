#pragma once

#include <string>

#include "render/image/read_image.h"

namespace boule {

/// Reads a picture that a scene names. Only regular files are read, as for scenes: other names are
/// refused before the image module is loaded.
Result<Image> read_picture(const std::string& path, PictureContent content);

}  // namespace boule
