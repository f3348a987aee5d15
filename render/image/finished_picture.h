#pragma once

#include <string>
#include <vector>

#include "render/image/write_image.h"

namespace boule {

/// What a picture has that write_image() makes.
struct PictureShape {
  int width, height;                    ///< of a crop, where it is one
  CropWindow crop;                      ///< where that lies, if the format can say so
  std::vector<std::string> channels{};  ///< beside R, G and B
};

/// True if there is a picture of that name already, as write_image() leaves it: a regular file that
/// can be read to its end, of this shape, and does not say in its ImageDescription that it is
/// partial. Any name and any shape will do. False as well where the module that reads pictures
/// cannot be loaded. Throws std::bad_alloc.
bool is_finished_picture(const std::string& path, const PictureShape& shape);

}  // namespace boule
