#pragma once

#include <atomic>
#include <memory>
#include <string>

#include "core/base/error.h"

namespace boule {

class Threads;

/// Loads OpenImageIO for a picture that write_image() is to write later, and starts all threads
/// which that will ever start, in a thread of its own: beside the work, and what can fail there
/// fails before the work and not after it.
class ImageStart {
 public:
  /// Begins, for a picture of this name and ImageFileOptions::threads; any values will do. Where
  /// there is no thread to be had it is done in the caller's, before this returns. Throws
  /// std::bad_alloc.
  ImageStart(std::string path, int threads);
  /// Waits for its end: half a second at most, where the system is idle.
  ~ImageStart();
  ImageStart(const ImageStart&) = delete;
  ImageStart& operator=(const ImageStart&) = delete;

  /// Whether wait() would return at once.
  [[nodiscard]] bool done() const { return done_; }

  /// Waits for its end: nothing, or "cannot write 'NAME': REASON", which write_image() would say,
  /// too.
  Status wait();

 private:
  void run();
  [[nodiscard]] Status load() const;

  const std::string path_;
  const int threads_;
  Status status_;  // once it is done
  bool out_of_memory_ = false;
  std::atomic<bool> done_{false};
  std::unique_ptr<Threads> thread_;
};

}  // namespace boule
