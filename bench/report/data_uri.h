#pragma once

#include <string>

#include "render/image/image.h"

namespace boule::bench {

/// A picture as 8-bit PNG in a data: URI.
std::string png_uri(const Image& image);

}  // namespace boule::bench
