#pragma once

#include <cstdint>
#include <string>

#include "core/base/error.h"

namespace boule {

/// Bytes of memory that this process could have now without swapping: what the system has, what a
/// limit on its addresses (RLIMIT_AS) and the control groups it is in (version 2) leave it. The
/// largest number where nothing of that is known. All here throw std::bad_alloc.
std::uint64_t available_memory();

/// What is left below a limit on this process' addresses; the largest number without one.
std::uint64_t address_room();

/// What a control group leaves to those in it, from the files in its folder; the largest number
/// where it has no limit.
std::uint64_t control_group_memory(const std::string& folder);

/// Nothing where so many bytes are available, else "WHO N MiB of memory, there are M" with this
/// key: who = "a picture of 3 x 2 pixels needs".
Status check_memory(std::uint64_t bytes, const std::string& who, const std::string& key = {});

}  // namespace boule
