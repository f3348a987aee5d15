#pragma once

#include <string>

#include "core/base/error.h"
#include "render/image/image.h"

namespace boule {

/// What the numbers of a picture are: colours, which become linear where the file has integers,
/// codes of the sRGB curve (PNG, JPEG, ...), or just numbers, which stay as they stand, integers as
/// 0..1.
enum class PictureContent { colors, numbers };

/// Reads a picture by its extension, one of those write_image knows: its first three channels, a
/// single one as gray, a missing third one as 0; alpha is left out. A part of a frame (EXR's data
/// window) is refused. The Diagnostic says "cannot read it: REASON"; its file is `path`.
/// Numbers are as in the file: NaN, infinite or negative ones too. Any file will do; what does not
/// fit into memory is refused before it is read. Of PNG files of nonsense with true checksums
/// libpng may tell standard error a line. Loads OpenImageIO as write_image() does, with what is
/// said there of memory.
Result<Image> read_image(const std::string& path, PictureContent content);

}  // namespace boule
