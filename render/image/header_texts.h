#pragma once

#include <string>

#include "render/image/image_format.h"
#include "render/image/write_image.h"

namespace boule {

/// Makes metadata safe for libraries below OpenImageIO, which end the process over some texts.
/// Texts and names are cut at their first NUL byte. An entry with an empty text or name is removed,
/// and so are the entries of its name before it. Returns what is wrong with the rest, or an empty
/// text.
std::string prepare_header_texts(Metadata& metadata, const ImageFormat& format);

}  // namespace boule
