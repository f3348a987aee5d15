#pragma once

#include <cstdint>
#include <string>

#include "core/base/error.h"

namespace boule {

/// Bytes of memory that this process could have now without swapping: what the system has, what
/// limits of its own (ProcessRoom) and the control groups it is in (version 2) leave it. The
/// largest number where nothing of that is known. All here throw std::bad_alloc.
std::uint64_t available_memory();

/// What is left below the limits on this process; the largest number without one.
struct ProcessRoom {
  std::uint64_t addresses;  ///< RLIMIT_AS: of all it maps
  std::uint64_t data;       ///< RLIMIT_DATA: of what it may write to, stacks of threads included
};
ProcessRoom process_room();

/// The same for memory, which is both: the lesser.
std::uint64_t address_room();

/// What a control group leaves to those in it, from the files in its folder; the largest number
/// where it has no limit.
std::uint64_t control_group_memory(const std::string& folder);

/// Nothing where so many bytes are available, else "WHO N MiB of memory, there are M" with this
/// key: who = "a picture of 3 x 2 pixels needs".
Status check_memory(std::uint64_t bytes, const std::string& who, const std::string& key = {});

}  // namespace boule
