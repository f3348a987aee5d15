#pragma once

#include <string>

#include "render/image/image_format.h"
#include "render/image/write_image.h"

namespace boule {

/// Makes metadata fit to be handed on, for libraries below OpenImageIO end the process over some
/// texts: texts and names end at their first NUL byte, and an entry whose text or name is empty is
/// left out, as are earlier ones of its name. Gives what is wrong with the rest, or an empty text.
/// Throws std::bad_alloc.
std::string prepare_header_texts(Metadata& metadata, const ImageFormat& format);

}  // namespace boule
