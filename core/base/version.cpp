#include "core/base/version.h"

namespace boule {

const char* library_version() { return BOULE_VERSION; }

}  // namespace boule
