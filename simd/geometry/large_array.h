#pragma once

#include <algorithm>
#include <cstddef>
#include <cstring>
#include <new>
#include <type_traits>
#include <utility>

#include "core/base/memory_pages.h"
#include "simd/abi/isa.h"

namespace boule {

/// An array of plain values, which it owns unless it is borrowed(). It starts on a cache line and
/// may take much of the memory. New values are uninitialized, so the code that fills the array
/// touches its pages first, on all its threads. The pages can be given back while the array is
/// consumed. Precondition of indexing: the index is in range. Throws std::bad_alloc; an array that
/// was moved from is empty.
template <class T>
class LargeArray {
  static_assert(std::is_trivially_copyable_v<T> && std::is_trivially_destructible_v<T>);

 public:
  LargeArray() = default;
  explicit LargeArray(std::size_t size) : data_(take(size)), size_(size), capacity_(size) {}
  /// A read-only view of foreign memory, which must outlive it. Its capacity is 0.
  static LargeArray borrowed(const T* data, std::size_t size) {
    LargeArray view;
    view.data_ = const_cast<T*>(data);
    view.size_ = size;
    return view;
  }
  LargeArray(LargeArray&& other) noexcept { swap(other); }
  LargeArray& operator=(LargeArray&& other) noexcept {
    LargeArray(std::move(other)).swap(*this);
    return *this;
  }
  ~LargeArray() { give_back(data_, capacity_); }

  [[nodiscard]] std::size_t size() const { return size_; }
  [[nodiscard]] bool empty() const { return size_ == 0; }
  T* data() { return data_; }
  const T* data() const { return data_; }
  T& operator[](std::size_t i) { return data_[i]; }
  const T& operator[](std::size_t i) const { return data_[i]; }
  T* begin() { return data_; }
  T* end() { return data_ + size_; }
  const T* begin() const { return data_; }
  const T* end() const { return data_ + size_; }

  /// Makes room for at least this many values and keeps the present ones, possibly at another
  /// address. Unused room is cheap: large arrays take memory only where they are written.
  void reserve(std::size_t capacity) {
    if (capacity > capacity_) set_capacity(std::max(capacity, capacity_ + capacity_ / 2));
  }
  /// New values are uninitialized.
  void resize(std::size_t size) {
    reserve(size);
    size_ = size;
  }
  /// Gives back the unused room.
  void shrink_to_fit() {
    if (size_ < capacity_) set_capacity(size_);
  }

 private:
  static std::size_t bytes_of(std::size_t size) {
    if (size > static_cast<std::size_t>(-1) / 2 / sizeof(T)) throw std::bad_alloc();
    return size * sizeof(T);
  }
  /// Whether an array of this size has pages of its own.
  static bool is_large(std::size_t size) { return bytes_of(size) >= std::size_t{2} << 20; }

  static T* take(std::size_t size) {
    if (size == 0) return nullptr;
    if (!is_large(size)) {
      return static_cast<T*>(::operator new (bytes_of(size), std::align_val_t{stream_alignment}));
    }
    void* const memory = take_pages(bytes_of(size));
    if (memory == nullptr) throw std::bad_alloc();
    return static_cast<T*>(memory);
  }
  static void give_back(T* data, std::size_t size) {
    if (size == 0) return;  // empty, or a borrowed array
    if (is_large(size)) {
      give_back_pages(data, bytes_of(size));
    } else {
      ::operator delete (data, std::align_val_t{stream_alignment});
    }
  }

  void set_capacity(std::size_t capacity) {
    if (is_large(capacity) && is_large(capacity_)) {
      void* const memory = resize_pages(data_, bytes_of(capacity_), bytes_of(capacity));
      if (memory == nullptr) throw std::bad_alloc();
      data_ = static_cast<T*>(memory);
    } else {
      T* const data = take(capacity);
      if (size_ > 0) std::memcpy(data, data_, bytes_of(size_));
      give_back(data_, capacity_);
      data_ = data;
    }
    capacity_ = capacity;
  }
  void swap(LargeArray& other) noexcept {
    std::swap(data_, other.data_);
    std::swap(size_, other.size_);
    std::swap(capacity_, other.capacity_);
  }

  T* data_ = nullptr;
  std::size_t size_ = 0, capacity_ = 0;
};

/// Gives the memory of an array back from its front on, as it is consumed: in steps of whole huge
/// pages, because part of one would stay. The array's values must be trivial.
class ConsumedPages {
 public:
  explicit ConsumedPages(void* array) : next_(static_cast<char*>(array)) {}

  /// The values before `end`, in the same array, are consumed. One call at a time.
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
