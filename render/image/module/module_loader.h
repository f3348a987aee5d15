#pragma once

#include "core/base/error.h"
#include "render/image/image_format.h"
#include "render/image/module/image_module.h"

namespace boule {

/// The image module, loaded and ready.
struct LoadedModule {
  const image_module::Table* table;
  int threads;  ///< number of threads to write with: the requested number, or 1
};

/// The image module (module_search.h), ready for files of this format. The first call loads it, and
/// it stays loaded; after a failure the next call tries again. Starts all threads of OpenImageIO
/// and OpenEXR for such files: `threads` of them, at most 256, or none if the system refuses them.
/// The Diagnostic is one of these:
/// - the folders in which the module was looked for;
/// - memory or threads are missing, without which libraries below OpenImageIO end the process;
/// - this process was forked from one whose threads it would need.
Result<LoadedModule> load_image_module(const ImageFormat& format, int threads = 1);

/// The same for writing alone, which some formats can do without the module (built_in_table.h).
Result<LoadedModule> load_image_writer(const ImageFormat& format, int threads);

}  // namespace boule
