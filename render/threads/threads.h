#pragma once

#include <cstddef>
#include <new>
#include <system_error>
#include <thread>
#include <vector>

namespace boule {

/// How many threads the hardware runs at once, 1 where that is not known.
unsigned hardware_threads();

/// So many threads, or as many as can be had; each calls body(0), body(1), .. in its turn.
template <class Body>
std::vector<std::thread> start_threads(std::size_t count, const Body& body) {
  std::vector<std::thread> threads;
  try {
    threads.reserve(count);
    while (threads.size() < count)
      threads.emplace_back([body, index = threads.size()] { body(index); });
  } catch (const std::system_error&) {  // those that started do the work
  } catch (const std::bad_alloc&) {
  }
  return threads;
}

/// Whether so many threads can run at once besides the caller's: tries it. For what starts threads
/// of its own and cannot do without.
bool can_start_threads(std::size_t count);

}  // namespace boule
