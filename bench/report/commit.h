#pragma once

#include <string>

namespace boule::bench {

/// The abbreviated commit of this build, with "+" if files were changed; "unknown" outside of git.
std::string commit_of_build();

}  // namespace boule::bench
