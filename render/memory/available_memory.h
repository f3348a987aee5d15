#pragma once

#include <cstdint>
#include <string>

#include "core/base/error.h"

namespace boule {

/// Bytes of memory that this process could take now without swapping: the least of what the system
/// has, of what the limits on the process leave (ProcessRoom), and of what its control groups leave
/// (version 2). The largest number if none of that is known.
std::uint64_t available_memory();

/// Bytes that the limits on this process leave; the largest number where there is no limit.
struct ProcessRoom {
  std::uint64_t addresses;  ///< below RLIMIT_AS, which counts everything that is mapped
  std::uint64_t data;       ///< below RLIMIT_DATA, which counts what is writable, stacks included
};
ProcessRoom process_room();

/// Bytes of memory that these limits leave: memory counts for both of them.
std::uint64_t address_room();

/// Bytes that a control group leaves its processes, read from the files in its folder; the largest
/// number if it has no limit.
std::uint64_t control_group_memory(const std::string& folder);

/// "N MiB of memory", rounded up.
std::string memory_text(std::uint64_t bytes);

/// An error if fewer bytes are available: "WHO N MiB of memory, there are M", with this key. An
/// example of `who` is "a picture of 3 x 2 pixels needs".
Status check_memory(std::uint64_t bytes, const std::string& who, const std::string& key = {});

}  // namespace boule
