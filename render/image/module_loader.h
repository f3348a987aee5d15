#pragma once

#include "core/base/error.h"
#include "render/image/image_format.h"
#include "render/image/image_module.h"

namespace boule {

/// The image module as it may be used.
struct LoadedModule {
  const image_module::Table* table;
  int threads;  ///< that writing may be told: all that were wanted, or one
};

/// The image module (module_search.h) for a file of this format, loaded on the first call, with all
/// threads started that it will ever start for such files: of `threads` wanted, 256 at most, all or
/// one, where those of OpenImageIO and OpenEXR could not be had. The Diagnostic says what was
/// tried; or that the memory or threads cannot be had without which libraries below OpenImageIO end
/// the process; or that this process was forked from one with threads that it has not. It stays
/// loaded; a failure is tried anew by the next call. Throws std::bad_alloc.
Result<LoadedModule> load_image_module(const ImageFormat& format, int threads = 1);

}  // namespace boule
