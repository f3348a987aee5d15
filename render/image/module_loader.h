#pragma once

#include "core/base/error.h"
#include "render/image/image_format.h"
#include "render/image/image_module.h"

namespace boule {

/// The image module, loaded and ready.
struct LoadedModule {
  const image_module::Table* table;
  int threads;  ///< with how many to write: as many as were wanted, or 1
};

/// The image module (module_search.h), ready for files of this format. The first call loads it, and
/// it stays loaded; after a failure the next call tries again. All threads that OpenImageIO and
/// OpenEXR will need for such files are started here: `threads` of them, 256 at most, or none if
/// they cannot be had. The Diagnostic says one of these:
/// - where the module was looked for;
/// - that memory or threads are missing, without which libraries below OpenImageIO end the process;
/// - that this process was forked from one whose threads it would need.
Result<LoadedModule> load_image_module(const ImageFormat& format, int threads = 1);

/// The same for writing alone, which some formats do without the module (built_in_table.h).
Result<LoadedModule> load_image_writer(const ImageFormat& format, int threads);

}  // namespace boule
