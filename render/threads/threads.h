#pragma once

#include <pthread.h>

#include <cstddef>
#include <functional>
#include <vector>

namespace boule {

/// Bytes of stack that a thread has unless it is asked for more; the system's default, not 0.
std::size_t default_stack();

/// How many threads the hardware runs at once, 1 where that is not known.
unsigned hardware_threads();

/// Threads that run the same function, joined at the end. Each has stack enough for kernels and
/// shading, however little of it a process is given (ulimit -s).
class Threads {
 public:
  /// So many, or as many as can be had; each calls run(0), run(1), .. in its turn, which
  /// must not throw.
  Threads(std::size_t count, std::function<void(std::size_t index)> run);
  ~Threads();
  Threads(const Threads&) = delete;
  Threads& operator=(const Threads&) = delete;

  [[nodiscard]] std::size_t size() const { return threads_.size(); }

 private:
  const std::function<void(std::size_t)> run_;
  std::vector<pthread_t> threads_;
};

/// Whether so many threads can run at once besides the caller's: tries it. For what starts threads
/// of its own and cannot do without.
bool can_start_threads(std::size_t count);

}  // namespace boule
