#pragma once

#include <string>

namespace boule {

/// True if there is a picture of that name already, as write_image() leaves it: a regular file that
/// can be read to its end, of `width` x `height` pixels (of a crop, where it is one), and does not
/// say in its ImageDescription that it is partial. False as well where the module that reads
/// pictures cannot be loaded. Throws std::bad_alloc.
bool is_finished_picture(const std::string& path, int width, int height);

}  // namespace boule
