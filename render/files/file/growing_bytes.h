#pragma once

#include <cstddef>
#include <utility>

#include "core/base/error.h"

namespace boule {

/// Bytes outside the heap that grow without being copied or cleared: for texts whose length is not
/// known before they end. The destructor gives them back.
class GrowingBytes {
 public:
  GrowingBytes() = default;
  GrowingBytes(GrowingBytes&& other) noexcept
      : data_(std::exchange(other.data_, nullptr)),
        size_(std::exchange(other.size_, 0)),
        capacity_(std::exchange(other.capacity_, 0)) {}
  GrowingBytes& operator=(GrowingBytes&& other) noexcept {
    std::swap(data_, other.data_);
    std::swap(size_, other.size_);
    std::swap(capacity_, other.capacity_);
    return *this;
  }
  ~GrowingBytes();

  [[nodiscard]] char* data() const { return data_; }
  [[nodiscard]] std::size_t size() const { return size_; }
  [[nodiscard]] std::size_t capacity() const { return capacity_; }

  /// Makes room for `capacity` bytes in all, or more. An error where memory does not suffice,
  /// before any is taken.
  Status reserve(std::size_t capacity);

  /// Makes room for more bytes than there are: half as many again, and a block at least.
  Status grow();

  /// The first `size` bytes are in use. Precondition: size <= capacity().
  void set_size(std::size_t size) { size_ = size; }

 private:
  char* data_ = nullptr;
  std::size_t size_ = 0;
  std::size_t capacity_ = 0;
};

}  // namespace boule
