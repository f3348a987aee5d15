#pragma once

#include "core/base/error.h"
#include "render/image/image_format.h"
#include "render/image/image_module.h"

namespace boule {

/// The image module for a file of this format, loaded on the first call: from the folder of the
/// running library or program, ../lib/boule beside it, the build tree, the place of installation.
/// The Diagnostic says what was tried, or that the threads cannot be had which OpenImageIO and the
/// libraries below it start, for they end the program then. It stays loaded; a failure is tried
/// anew by the next call.
Result<const image_module::Table*> load_image_module(const ImageFormat& format);

/// How many threads the module may be given of `wanted`: all, 256 at most, or one where OpenImageIO
/// and OpenEXR could not have theirs.
int image_threads(int wanted);

}  // namespace boule
