#pragma once

#include <atomic>
#include <memory>
#include <string>

#include "core/base/error.h"

namespace boule {

class Threads;

/// Loads OpenImageIO for a picture that write_image() will write later, if its format needs it, and
/// starts all threads for that. It does so in a thread of its own, beside the rendering, so
/// failures show before the rendering is done.
class ImageStart {
 public:
  /// Begins, for a picture of this name and with these ImageFileOptions::threads. Takes any values.
  /// If a new thread is refused, the caller's thread does it all before this returns.
  ImageStart(std::string path, int threads);
  /// Waits until it is done: half a second at most on an idle system.
  ~ImageStart();
  ImageStart(const ImageStart&) = delete;
  ImageStart& operator=(const ImageStart&) = delete;

  /// True if wait() would return at once.
  [[nodiscard]] bool done() const { return done_; }

  /// Waits until it is done. A failure is that of write_image(): "cannot write 'NAME': REASON".
  Status wait();

 private:
  void run();
  [[nodiscard]] Status load() const;

  const std::string path_;
  const int threads_;
  Status status_;  ///< valid once it is done
  bool out_of_memory_ = false;
  std::atomic<bool> done_{false};
  std::unique_ptr<Threads> thread_;
};

}  // namespace boule
