#pragma once

#include <cstddef>

namespace boule {

/// Asks the system to back memory that is not yet used with huge pages. With pages of 4 KiB, their
/// first touch costs as much as reading a file into them. A hint: nothing depends on the outcome.
void prefer_huge_pages(void* memory, std::size_t bytes);

}  // namespace boule
