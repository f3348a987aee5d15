#include "core/base/version.h"

#include "core/base/exact_math.h"

namespace boule {

const char* library_version() { return BOULE_VERSION; }

}  // namespace boule
