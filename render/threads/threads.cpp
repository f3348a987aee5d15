#include "render/threads/threads.h"

#include <algorithm>
#include <atomic>

namespace boule {

unsigned hardware_threads() { return std::max(std::thread::hardware_concurrency(), 1U); }

bool can_start_threads(std::size_t count) {
  std::atomic<bool> counted{false};
  auto threads = start_threads(count, [&counted](std::size_t) { counted.wait(false); });
  counted = true;
  counted.notify_all();
  for (std::thread& thread : threads) thread.join();
  return threads.size() == count;
}

}  // namespace boule
