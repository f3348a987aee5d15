#pragma once

#include <string>

#include "core/base/error.h"
#include "render/image/image.h"

namespace boule {

/// What the numbers of a picture mean.
/// - colors: colours. Integers (PNG, JPEG, ...) are codes of the sRGB curve and become linear.
/// - numbers: numbers that stay as they are, with integers as 0..1.
enum class PictureContent { colors, numbers };

/// Reads a picture in the format of its extension, one that write_image() knows. It takes the first
/// three channels: a single one counts as gray, a third one that is missing is 0, alpha is left
/// out. Numbers are as they are in the file, also NaN, infinite and negative ones. A part of a
/// frame (EXR's data window) is refused, and so is a picture that does not fit into memory. Takes
/// any file. The Diagnostic says "cannot read it: REASON", and its file is `path`.
///
/// OpenImageIO is loaded as by write_image(), where more is said of that. It ends the process by
/// std::terminate() where an allocation fails in functions of its own that must not throw. libpng
/// may write a line to standard error about a PNG file that has nonsense in it under correct
/// checksums.
Result<Image> read_image(const std::string& path, PictureContent content);

}  // namespace boule
