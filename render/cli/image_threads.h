#pragma once

namespace boule::cli {

/// How many threads write_image() may be given of `wanted`, >= 1: all, or one where OpenImageIO and
/// OpenEXR could not have theirs, for they end the program then. 0 if the libraries they come with
/// could not even be loaded: those start four.
int image_threads(unsigned wanted);

}  // namespace boule::cli
