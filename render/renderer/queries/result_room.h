#pragma once

#include <atomic>
#include <cstdint>
#include <string>

#include "core/base/error.h"
#include "render/memory/available_memory.h"

namespace boule {

/// Counts results in pieces, for any threads; they are to be dropped once the memory has no room
/// for them.
class ResultRoom {
 public:
  /// `bytes`: taken anyway; `bytes_each`: of a result, in its piece and in its columns at the same
  /// time.
  ResultRoom(std::uint64_t bytes, std::uint64_t bytes_each)
      : bytes_(bytes), bytes_each_(bytes_each) {}

  /// Counts so many results more. Whether all have room.
  bool take(std::size_t results) {
    count_ += results;
    return !is_full();
  }
  [[nodiscard]] bool is_full() const { return bytes() > available_; }
  [[nodiscard]] std::uint64_t count() const { return count_; }

  /// An error if they have no room: "RESULTS need N MiB of memory, there are M".
  [[nodiscard]] Status check(const std::string& results) const {
    if (!is_full()) return {};
    return Diagnostic::out_of_memory(results + " need " + memory_text(bytes()) + ", there are " +
                                     memory_text(available_));
  }

 private:
  [[nodiscard]] std::uint64_t bytes() const { return bytes_ + count_ * bytes_each_; }

  std::uint64_t bytes_, bytes_each_;
  std::uint64_t available_ = available_memory();
  std::atomic<std::uint64_t> count_{0};
};

}  // namespace boule
