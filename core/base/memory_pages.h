#pragma once

#include <cstddef>

namespace boule {

/// Asks the system to back memory that is not yet used with huge pages. With pages of 4 KiB, their
/// first touch costs as much as reading a file into them. A hint: nothing depends on the outcome.
void prefer_huge_pages(void* memory, std::size_t bytes);

/// Gives the memory of these bytes back to the system while it stays allocated, so that what is
/// moved to another place needs no memory twice. What the bytes hold afterwards is undefined; they
/// can be written again, and the memory is freed as it would have been. Only whole pages are given
/// back, and on systems other than Linux none. Precondition: private memory, not that of a file.
void release_pages(void* memory, std::size_t bytes);

}  // namespace boule
