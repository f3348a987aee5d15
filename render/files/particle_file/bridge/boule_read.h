#pragma once

#include <string_view>

namespace boule {

/// The text of bridge/boule_read.py, which CMake puts into the library.
extern const std::string_view boule_read_script;

}  // namespace boule
