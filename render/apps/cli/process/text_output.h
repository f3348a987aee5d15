#pragma once

#include <string>

#include "core/base/error.h"

namespace boule::cli {

/// Writes a file of text, which appears under its name when it is complete. To be called within a
/// WriteGuard: a signal ends the waiting for a pipe's reader.
Status write_text_file(const std::string& text, const std::string& path);

}  // namespace boule::cli
