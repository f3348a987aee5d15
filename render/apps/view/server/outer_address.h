#pragma once

#include <string>

namespace boule::view {

/// The address of this machine, in numbers, from which it would reach others, and by which they
/// reach it: of IPv6 or IPv4. Without a way to others, the one that is this machine's alone.
std::string outer_address(bool is_v6);

}  // namespace boule::view
