#pragma once

#include <cstddef>

#include "core/base/parallel.h"

namespace boule {

/// Asks the system to back memory that is not yet used with huge pages. With pages of 4 KiB, their
/// first touch costs as much as reading a file into them. A hint: nothing depends on the outcome.
void prefer_huge_pages(void* memory, std::size_t bytes);

/// Gives the memory of these bytes back to the system while it stays allocated, so that what is
/// moved to another place needs no memory twice. What the bytes hold afterwards is undefined; they
/// can be written again, and the memory is freed as it would have been. Only whole pages are given
/// back, and on systems other than Linux none. Precondition: private memory, not that of a file.
void release_pages(void* memory, std::size_t bytes);

/// Has memory that was not used yet cleared by the system, on all threads: otherwise the thread
/// that writes it first waits for that. Writes a byte of each page.
void touch_pages(void* memory, std::size_t bytes, const ParallelFor& parallel_for);

/// Memory of at least so many bytes, more than none, straight from the system: cleared, in whole
/// pages, and laid out for huge ones. It counts as used only where it is touched. Null if there is
/// none.
void* take_pages(std::size_t bytes);
/// Makes memory of take_pages() larger or smaller. What it holds stays, also where it moves to
/// another place, which copies nothing. Null if there is no room: then all is as it was.
void* resize_pages(void* memory, std::size_t bytes, std::size_t wanted);
/// Ends the use of memory of take_pages().
void give_back_pages(void* memory, std::size_t bytes);

}  // namespace boule
