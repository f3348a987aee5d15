#pragma once

#include <optional>
#include <string>

#include "core/base/error.h"
#include "render/apps/cli/options/options.h"
#include "render/image/image_format.h"

namespace boule::cli {

/// The output as messages call it.
std::string shown_output(const RenderCommand& command);

/// An error in the options of pictures on standard output: they need a format, they have no name
/// and no channels, and nothing else may be written there. Or the format is given for a file.
Status check_picture_stream(const RenderCommand& command);

/// What the picture's format, or that of the picture in a page, can hold; null if the file's
/// extension is unknown. Precondition: check_picture_stream() passes the command.
const ImageFormat* picture_format(const RenderCommand& command);

/// The name of the picture for ImageStart; none if OpenImageIO is not needed.
std::optional<std::string> file_to_encode(const RenderCommand& command);

/// Writes a picture to standard output, where `movie`, if it has a name, is made of it.
/// options.temporary is called with an empty name once it is encoded; options.stop is asked ten
/// times a second while the reader is slow.
Status send_picture(const Image& image, StreamFormat format, const std::string& movie,
                    const ImageFileOptions& options);

}  // namespace boule::cli
