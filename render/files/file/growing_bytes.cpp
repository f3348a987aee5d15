#include "render/files/file/growing_bytes.h"

#include <algorithm>
#include <string>

#include "core/base/memory_pages.h"
#include "render/memory/available_memory.h"

namespace boule {

GrowingBytes::~GrowingBytes() {
  if (data_ != nullptr) give_back_pages(data_, capacity_);
}

Status GrowingBytes::reserve(std::size_t capacity) {
  if (capacity <= capacity_) return {};
  const std::size_t more = capacity - capacity_;
  const std::string who = capacity_ == 0 ? "unpacked, it needs" : "unpacked, it needs another";
  if (auto room = check_memory(more, who); !room) return room;
  void* const grown =
      data_ == nullptr ? take_pages(capacity) : resize_pages(data_, capacity_, capacity);
  if (grown == nullptr)
    return Diagnostic::out_of_memory(who + " " + memory_text(more) + ", which the system refuses");
  data_ = static_cast<char*>(grown);
  capacity_ = capacity;
  return {};
}

Status GrowingBytes::grow() {
  constexpr std::size_t block = std::size_t{1} << 20;
  return reserve(capacity_ + std::max(block, capacity_ / 2));
}

}  // namespace boule
