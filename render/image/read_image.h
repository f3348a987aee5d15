#pragma once

#include <string>

#include "core/base/error.h"
#include "render/image/image.h"

namespace boule {

/// The meaning of the numbers in a picture.
/// - colors: colours. Integers (PNG, JPEG, ...) are codes of the sRGB curve and become linear.
/// - numbers: numbers that stay as they are, with integers as 0..1.
enum class PictureContent { colors, numbers };

/// Reads a picture in the format of its extension, one that write_image() knows. It takes the first
/// three channels: a single one counts as gray, a missing third one is 0, and alpha is left out.
/// Numbers keep the values in the file, NaN, infinite and negative ones included. A part of a frame
/// (EXR's data window) is refused, and so is a picture that exceeds the available memory. Takes any
/// file. The Diagnostic says "cannot read it: REASON", and its file is `path`.
///
/// The first call may load OpenImageIO: see write_image(). OpenImageIO ends the process by
/// std::terminate() if an allocation fails in functions of its own that must not throw. libpng may
/// write a line to standard error about a PNG file that holds nonsense under correct checksums.
Result<Image> read_image(const std::string& path, PictureContent content);

}  // namespace boule
