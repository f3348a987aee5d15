#pragma once

#include <string>
#include <string_view>

namespace boule {

/// What helps with a file that Boule does not read, for the end of an error's message: "; Python's
/// boule.from_ase shows what ASE reads", or by the file's name what converts it.
std::string advice_for(std::string_view path);

}  // namespace boule
