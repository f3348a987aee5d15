#pragma once

#include <string>

#include "render/image/image_format.h"
#include "render/image/write_image.h"

namespace boule {

/// Makes metadata safe for libraries below OpenImageIO, which end the process over some texts. Cuts
/// texts and names at their first NUL byte. Removes an entry with an empty text or name, together
/// with earlier entries of that name. Returns the error in the rest, or an empty text.
std::string prepare_header_texts(Metadata& metadata, const ImageFormat& format);

}  // namespace boule
