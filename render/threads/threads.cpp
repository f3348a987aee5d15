#include "render/threads/threads.h"

#include <algorithm>
#include <atomic>
#include <exception>
#include <fstream>
#include <iterator>
#include <memory>
#include <new>
#include <thread>
#include <utility>

#include "render/threads/cpu_quota.h"
#include "render/threads/waiting_thread.h"

namespace boule {
namespace {

constexpr std::size_t least_stack = std::size_t{4} << 20;

/// The stack of each thread: the default, but enough for kernels and shading.
std::size_t stack_size() { return std::max(default_stack(), least_stack); }

std::atomic<unsigned> thread_limit{0};

/// None where there is no memory to read it: destructors ask, too.
unsigned own_quota() noexcept {
  try {
    std::ifstream file("/proc/self/cgroup");
    return quota_threads({std::istreambuf_iterator<char>(file), {}}, "/sys/fs/cgroup");
  } catch (const std::exception&) {
    return 0;
  }
}

}  // namespace

std::size_t default_stack() {
  pthread_attr_t attributes{};
  std::size_t size = 0;
  pthread_getattr_default_np(&attributes);
  pthread_attr_getstacksize(&attributes, &size);
  pthread_attr_destroy(&attributes);
  return size;
}

unsigned hardware_threads() {
  static const unsigned quota = own_quota();
  unsigned threads = std::max(std::thread::hardware_concurrency(), 1U);
  for (const unsigned most : {quota, thread_limit.load()}) {
    if (most > 0) threads = std::min(threads, most);
  }
  return threads;
}

void limit_threads(unsigned most) { thread_limit = most; }

Threads::Threads(std::size_t count, std::function<void(std::size_t)> run) : run_(std::move(run)) {
  const std::size_t stack = stack_size();
  try {
    threads_.reserve(count);
    while (threads_.size() < count) {
      WaitingThread* const thread = WaitingThread::take(stack);
      if (thread == nullptr) return;
      threads_.push_back(thread);
      thread->run([this, index = threads_.size() - 1] { run_(index); });
    }
  } catch (const std::bad_alloc&) {  // those that started do the work
  }
}

Threads::~Threads() {
  for (WaitingThread* const thread : threads_) thread->give_back();
}

void Threads::prepare(std::size_t count) {
  const Threads threads(std::min(count, WaitingThread::most_waiting()), [](std::size_t) {});
}

bool start_detached(std::function<void()> run) {
  const auto enter_run = [](void* start) -> void* {
    (*std::unique_ptr<std::function<void()>>(static_cast<std::function<void()>*>(start)))();
    return nullptr;
  };
  auto start = std::make_unique<std::function<void()>>(std::move(run));
  pthread_t thread{};
  if (!start_thread(stack_size(), enter_run, start.get(), thread)) return false;
  static_cast<void>(start.release());  // the thread deletes it
  pthread_detach(thread);
  return true;
}

bool can_start_threads(std::size_t count) { return WaitingThread::can_start(count, stack_size()); }

}  // namespace boule
