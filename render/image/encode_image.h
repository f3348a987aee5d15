#pragma once

#include <array>
#include <string>
#include <string_view>

#include "core/base/error.h"
#include "core/scene/names.h"
#include "render/image/write_image.h"

namespace boule {

/// The form of a picture in a pipe: a binary PPM of 8 bits (P6), a PNG, or the bytes of its pixels
/// alone, R, G, B from the upper left on.
enum class StreamFormat { ppm, png, rgb };
template <>
inline constexpr std::array<std::string_view, 3> names<StreamFormat>{"ppm", "png", "rgb"};

/// The picture as bytes. Several in a row make a stream of pictures. Colours, exposure, alpha,
/// metadata, threads and `stop` are as for write_image(). ppm and rgb drop metadata, refuse alpha
/// and work without OpenImageIO. The Diagnostic says "cannot write 'NAME': REASON" with this name.
Result<std::string> encode_image(const Image& image, StreamFormat format, const std::string& name,
                                 const ImageFileOptions& options = {});

}  // namespace boule
