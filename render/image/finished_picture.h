#pragma once

#include <string>
#include <vector>

#include "render/image/write_image.h"

namespace boule {

/// The size and the channels of a picture that write_image() makes.
struct PictureShape {
  int width, height;                    ///< of the crop, if it is one
  CropWindow crop;                      ///< compared if the format stores it
  std::vector<std::string> channels{};  ///< beside R, G and B
};

/// True if a finished picture of that name exists: a regular file of this shape that can be read to
/// its end, and whose ImageDescription does not say that it is partial. Takes any name and any
/// shape. False if the module that reads pictures cannot be loaded.
bool is_finished_picture(const std::string& path, const PictureShape& shape);

}  // namespace boule
