#pragma once

#include <cstddef>

namespace boule {

/// Asks the system to back this memory, not yet used, with huge pages: the first touch of 4 KiB at
/// a time costs as much as reading a file into it. A hint: nothing depends on the outcome.
void prefer_huge_pages(void* memory, std::size_t bytes);

}  // namespace boule
