#pragma once

#include <pthread.h>

#include <condition_variable>
#include <cstddef>
#include <functional>
#include <mutex>

namespace boule {

/// Starts a thread with so much stack, in bytes, and the default attributes else. False if none can
/// be had.
bool start_thread(std::size_t stack, void* (*enter)(void*), void* argument, pthread_t& thread);

/// A thread that runs one call after the other, and waits between them. Starting a thread takes a
/// lock that dlopen() holds while it loads a library; giving a call to a waiting one does not.
class WaitingThread {
 public:
  /// A thread with so much stack, in bytes, that belongs to the caller until give_back(): one that
  /// waits, or else a new one. Null if none can be had.
  static WaitingThread* take(std::size_t stack);
  /// Tries whether so many threads can run at once beside all that there are.
  static bool can_start(std::size_t count, std::size_t stack);
  /// How many threads stay when nobody has taken them: as many as the hardware runs at once, and
  /// two at least, because one may load a library beside the other's work.
  static std::size_t most_waiting();

  WaitingThread(const WaitingThread&) = delete;
  WaitingThread& operator=(const WaitingThread&) = delete;

  /// Lets it call `call`, which must not throw. Precondition: it runs none.
  void run(std::function<void()> call);
  [[nodiscard]] std::size_t stack() const { return stack_; }
  /// Waits until the call has returned, if there is one, and leaves the thread to the next caller.
  /// Invalidates it.
  void give_back();

 private:
  explicit WaitingThread(std::size_t stack) : stack_(stack) {}
  ~WaitingThread() = default;

  static WaitingThread* start_new(std::size_t stack);
  static void* enter(void* self);
  void work();
  void end();

  const std::size_t stack_;
  pthread_t thread_{};
  std::mutex mutex_;
  std::condition_variable changed_;
  std::function<void()> call_;  ///< empty: it waits
  bool ends_ = false;
};

}  // namespace boule
