#pragma once

#include <string>

namespace boule::bench {

/// Of what was built, abbreviated; "+" after it: with changes. "unknown" outside of git.
std::string commit_of_build();

}  // namespace boule::bench
