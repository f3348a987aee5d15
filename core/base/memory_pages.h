#pragma once

#include <cstddef>

#include "core/base/parallel.h"

namespace boule {

/// Asks the system to back unused memory with huge pages. With pages of 4 KiB, their first touch
/// costs as much as reading a file into them. This is a hint: results are the same either way.
void prefer_huge_pages(void* memory, std::size_t bytes);

/// Gives the memory of these bytes back to the system while it stays allocated, so that data that
/// are moved elsewhere take memory once. The contents become undefined; the bytes can be written
/// again, and the memory is freed as before. Only whole pages are given back; on systems other than
/// Linux, all pages stay. Precondition: private memory, rather than that of a file.
void release_pages(void* memory, std::size_t bytes);

/// Lets all threads make the system clear unused memory: otherwise the thread that writes it first
/// waits for that. Writes a byte of each page.
void touch_pages(void* memory, std::size_t bytes, const ParallelFor& parallel_for);

/// At least `bytes` bytes of memory, more than 0, straight from the system: cleared, in whole
/// pages, and laid out for huge ones. It counts as used only where it is touched. Null if there is
/// too little.
void* take_pages(std::size_t bytes);
/// Grows or shrinks memory of take_pages(). The contents stay, even if the memory moves to another
/// address, which takes no copying. Null if there is too little room; the memory then stays as it
/// was.
void* resize_pages(void* memory, std::size_t bytes, std::size_t wanted);
/// Frees memory of take_pages().
void give_back_pages(void* memory, std::size_t bytes);

}  // namespace boule
