#include "render/threads/waiting_thread.h"

#include <algorithm>
#include <new>
#include <utility>
#include <vector>

#include "render/threads/threads.h"

namespace boule {
namespace {

/// The threads that nobody has taken. A child that is forked has none of them.
class Idle {
 public:
  Idle() { pthread_atfork(lock_all, unlock_all, forget_all); }

  /// One with so much stack, or null.
  WaitingThread* take(std::size_t stack);
  /// False if there are enough already.
  bool add(WaitingThread* thread);

 private:
  static void lock_all();
  static void unlock_all();
  static void forget_all();

  std::mutex mutex_;
  std::vector<WaitingThread*> threads_;
};

/// It is never destroyed: its threads wait until the process ends.
Idle& idle() {
  static Idle& one = *new Idle;
  return one;
}

WaitingThread* Idle::take(std::size_t stack) {
  const std::lock_guard lock(mutex_);
  const auto found = std::find_if(threads_.begin(), threads_.end(),
                                  [stack](const auto* thread) { return thread->stack() >= stack; });
  if (found == threads_.end()) return nullptr;
  WaitingThread* const thread = *found;
  threads_.erase(found);
  return thread;
}

bool Idle::add(WaitingThread* thread) {
  const std::lock_guard lock(mutex_);
  if (threads_.size() >= WaitingThread::most_waiting()) return false;
  try {
    threads_.push_back(thread);
  } catch (const std::bad_alloc&) {
    return false;
  }
  return true;
}

void Idle::lock_all() { idle().mutex_.lock(); }
void Idle::unlock_all() { idle().mutex_.unlock(); }
void Idle::forget_all() {
  idle().threads_.clear();
  idle().mutex_.unlock();
}

}  // namespace

bool start_thread(std::size_t stack, void* (*enter)(void*), void* argument, pthread_t& thread) {
  pthread_attr_t attributes{};
  pthread_getattr_default_np(&attributes);
  pthread_attr_setstacksize(&attributes, stack);
  const bool started = pthread_create(&thread, &attributes, enter, argument) == 0;
  pthread_attr_destroy(&attributes);
  return started;
}

std::size_t WaitingThread::most_waiting() {
  static const std::size_t most = std::max(hardware_threads(), 2U);
  return most;
}

WaitingThread* WaitingThread::take(std::size_t stack) {
  WaitingThread* const waiting = idle().take(stack);
  return waiting != nullptr ? waiting : start_new(stack);
}

bool WaitingThread::can_start(std::size_t count, std::size_t stack) {
  std::vector<WaitingThread*> started;
  try {
    started.reserve(count);
    while (started.size() < count) {
      WaitingThread* const thread = start_new(stack);
      if (thread == nullptr) break;
      started.push_back(thread);
    }
  } catch (const std::bad_alloc&) {  // then there are too few
  }
  for (WaitingThread* const thread : started) thread->end();
  return started.size() == count;
}

WaitingThread* WaitingThread::start_new(std::size_t stack) {
  auto* const fresh = new WaitingThread(stack);
  if (start_thread(stack, enter, fresh, fresh->thread_)) return fresh;
  delete fresh;
  return nullptr;
}

void WaitingThread::run(std::function<void()> call) {
  {
    const std::lock_guard lock(mutex_);
    call_ = std::move(call);
  }
  changed_.notify_all();
}

void WaitingThread::give_back() {
  {
    std::unique_lock lock(mutex_);
    changed_.wait(lock, [this] { return !call_; });
  }
  if (!idle().add(this)) end();
}

void* WaitingThread::enter(void* self) {
  static_cast<WaitingThread*>(self)->work();
  return nullptr;
}

void WaitingThread::work() {
  std::unique_lock lock(mutex_);
  while (true) {
    changed_.wait(lock, [this] { return call_ || ends_; });
    if (!call_) return;
    lock.unlock();
    call_();
    lock.lock();
    call_ = nullptr;
    changed_.notify_all();
  }
}

void WaitingThread::end() {
  {
    const std::lock_guard lock(mutex_);
    ends_ = true;
  }
  changed_.notify_all();
  pthread_join(thread_, nullptr);
  delete this;
}

}  // namespace boule
