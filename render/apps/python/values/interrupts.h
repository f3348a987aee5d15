#pragma once

namespace boule::python {

/// Ctrl-C, for calls on threads to which Python gives no signals: all but the main one. While there
/// is one of these, the handler of SIGINT is preceded by one that counts.
class Interrupts {
 public:
  /// Needs the GIL, as all of this.
  Interrupts();
  ~Interrupts();
  Interrupts(const Interrupts&) = delete;
  Interrupts& operator=(const Interrupts&) = delete;

  /// True if the call is to end because of Ctrl-C, once for each: a SIGINT has come that Python
  /// answers with KeyboardInterrupt; or the main thread has begun to handle one; or one has ended
  /// an earlier call of this thread, and the main thread is still ending because of it.
  bool take();

 private:
  bool is_main_;
  bool is_late_ = false;
  bool has_taken_ = false;
  int at_begin_ = 0, known_ = 0;
  const void* handled_ = nullptr;
};

}  // namespace boule::python
