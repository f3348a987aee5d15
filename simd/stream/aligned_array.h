#pragma once

#include <algorithm>
#include <cstddef>
#include <memory>
#include <new>
#include <type_traits>
#include <utility>

#include "simd/abi/isa.h"

namespace boule {

/// An owning array of plain values that starts on a cache line and is padded to the widest packet.
/// Precondition of indexing: the index is in range. A resize that fails throws std::bad_alloc and
/// leaves the array as it was. An array that was moved from is empty.
template <class T>
class AlignedArray {
  static_assert(std::is_trivially_copyable_v<T>);

 public:
  AlignedArray() = default;
  explicit AlignedArray(std::size_t size, T fill = T{}) { resize(size, fill); }
  AlignedArray(AlignedArray&& other) noexcept
      : data_(std::move(other.data_)), capacity_(std::exchange(other.capacity_, 0)) {}
  AlignedArray& operator=(AlignedArray&& other) noexcept {
    data_ = std::move(other.data_);
    capacity_ = std::exchange(other.capacity_, 0);
    return *this;
  }

  /// Makes room for `size` values. If that needs new memory, all values become `fill`; otherwise
  /// they stay as they are.
  void resize(std::size_t size, T fill = T{}) {
    if (size > most) throw std::bad_alloc();
    const std::size_t wanted = padded(size);
    if (wanted > capacity_) {
      void* memory = ::operator new (wanted * sizeof(T), std::align_val_t{stream_alignment});
      data_.reset(static_cast<T*>(memory));
      capacity_ = wanted;
      std::uninitialized_fill_n(data_.get(), wanted, fill);
    }
  }

  T* data() { return data_.get(); }
  const T* data() const { return data_.get(); }
  T& operator[](std::size_t i) { return data_.get()[i]; }
  const T& operator[](std::size_t i) const { return data_.get()[i]; }

 private:
  static constexpr std::size_t most = static_cast<std::size_t>(-1) / sizeof(T) - max_width;

  struct Release {
    void operator()(T* data) const { ::operator delete (data, std::align_val_t{stream_alignment}); }
  };
  std::unique_ptr<T, Release> data_;
  std::size_t capacity_ = 0;
};

}  // namespace boule
