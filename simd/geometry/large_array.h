#pragma once

#include <cstddef>
#include <memory>
#include <new>
#include <type_traits>
#include <utility>

#include "core/base/memory_pages.h"
#include "simd/abi/isa.h"

namespace boule {

/// An array of plain values, which it owns unless it is borrowed(). It starts on a cache line and
/// may take much of the memory. Its values are not set: whoever fills it touches its pages first,
/// on as many threads as there are, and its pages can be given back while it is consumed. An index
/// within it is a precondition. Throws std::bad_alloc; an array that was moved away is empty.
template <class T>
class LargeArray {
  static_assert(std::is_trivially_copyable_v<T> && std::is_trivially_destructible_v<T>);

 public:
  LargeArray() = default;
  explicit LargeArray(std::size_t size) : data_(allocate(size)), size_(size) {}
  /// A view of others' memory, which must live longer and is only read.
  static LargeArray borrowed(const T* data, std::size_t size) {
    LargeArray view;
    view.data_ = {const_cast<T*>(data), Release{.is_own = false}};
    view.size_ = size;
    return view;
  }
  LargeArray(LargeArray&& other) noexcept
      : data_(std::move(other.data_)), size_(std::exchange(other.size_, 0)) {}
  LargeArray& operator=(LargeArray&& other) noexcept {
    data_ = std::move(other.data_);
    size_ = std::exchange(other.size_, 0);
    return *this;
  }

  [[nodiscard]] std::size_t size() const { return size_; }
  [[nodiscard]] bool empty() const { return size_ == 0; }
  T* data() { return data_.get(); }
  const T* data() const { return data_.get(); }
  T& operator[](std::size_t i) { return data_.get()[i]; }
  const T& operator[](std::size_t i) const { return data_.get()[i]; }
  T* begin() { return data(); }
  T* end() { return data() + size_; }
  const T* begin() const { return data(); }
  const T* end() const { return data() + size_; }

 private:
  static T* allocate(std::size_t size) {
    if (size == 0) return nullptr;
    if (size > static_cast<std::size_t>(-1) / sizeof(T)) throw std::bad_alloc();
    void* memory = ::operator new (size * sizeof(T), std::align_val_t{stream_alignment});
    prefer_huge_pages(memory, size * sizeof(T));
    return static_cast<T*>(memory);
  }

  struct Release {
    bool is_own = true;
    void operator()(T* data) const {
      if (is_own) ::operator delete (data, std::align_val_t{stream_alignment});
    }
  };
  std::unique_ptr<T, Release> data_;
  std::size_t size_ = 0;
};

/// Gives the memory of an array back from its front on, as it is consumed: in steps that are whole
/// huge pages, because part of one would stay. The array's values must be trivial.
class ConsumedPages {
 public:
  explicit ConsumedPages(void* array) : next_(static_cast<char*>(array)) {}

  /// The values before `end`, of the same array, are not needed any more. Not two calls at once.
  void consume(void* end) {
    const auto step = reinterpret_cast<std::size_t>(end) / huge_page * huge_page;
    const auto from = reinterpret_cast<std::size_t>(next_);
    if (step <= from) return;
    release_pages(next_, step - from);
    next_ += step - from;
  }

 private:
  static constexpr std::size_t huge_page = std::size_t{2} << 20;
  char* next_;
};

}  // namespace boule
