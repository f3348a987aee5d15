#pragma once

#include "core/base/error.h"
#include "render/image/image_module.h"

namespace boule {

/// The image module, loaded on the first call: from the folder of the running library or program,
/// ../lib/boule beside it, the build tree, the place of installation. The Diagnostic says what was
/// tried. It stays loaded; a failure is tried anew by the next call.
Result<const image_module::Table*> load_image_module();

}  // namespace boule
