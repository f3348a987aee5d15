#pragma once

#include <string>

#include "core/base/error.h"

namespace boule::bench {

/// Writes a file, or says that it cannot.
Status write_text(const std::string& path, const std::string& text);

}  // namespace boule::bench
