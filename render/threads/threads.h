#pragma once

#include <cstddef>
#include <functional>
#include <vector>

namespace boule {

/// Bytes of stack that a thread has by default; not 0.
std::size_t default_stack();

/// How many threads this process can run at once: on the processors that it is bound to, under the
/// quotas of its control groups when this was first called, and limit_threads(). 1 or more.
unsigned hardware_threads();

/// From now on hardware_threads() is `most` at most; 0: what it is without.
void limit_threads(unsigned most);

class WaitingThread;

/// Threads that run the same function; the destructor waits until they have. Each has enough stack
/// for kernels and shading, even if the process has little (ulimit -s).
class Threads {
 public:
  /// Starts `count` threads, or as many as can be had. Thread i calls run(i), which must not throw.
  Threads(std::size_t count, std::function<void(std::size_t index)> run);
  ~Threads();
  Threads(const Threads&) = delete;
  Threads& operator=(const Threads&) = delete;

  [[nodiscard]] std::size_t size() const { return threads_.size(); }

  /// Starts `count` threads that wait for their first function, but no more than stay and can be
  /// had, so that loops begin at once also while a library is loaded.
  static void prepare(std::size_t count);

 private:
  const std::function<void(std::size_t)> run_;
  std::vector<WaitingThread*> threads_;
};

/// Runs a function on a thread of its own that nobody waits for, with the same stack. False,
/// without a call, if no thread can be had. The function must not throw.
bool start_detached(std::function<void()> run);

/// Tries whether so many threads can run at once beside all that there are. For libraries that
/// start threads of their own and fail badly without them.
bool can_start_threads(std::size_t count);

}  // namespace boule
