#pragma once

#include <array>
#include <cstdint>
#include <cstring>
#include <string_view>
#include <unordered_map>
#include <vector>

namespace boule {

/// Numbers texts in the order of their first use. Most files have few of them, so short texts are
/// looked up in a small table before the large one. The texts' bytes stay the caller's.
class TextInterner {
 public:
  std::uint32_t index_of(std::string_view text) {
    Slot& slot = slots_[place_of(text)];
    if (slot.text == text && slot.index < texts_.size()) return slot.index;
    const auto next = static_cast<std::uint32_t>(texts_.size());
    const auto [found, is_new] = indices_.try_emplace(text, next);
    if (is_new) texts_.push_back(text);
    slot = {found->first, found->second};
    return found->second;
  }

  [[nodiscard]] const std::vector<std::string_view>& texts() const { return texts_; }

 private:
  struct Slot {
    std::string_view text;
    std::uint32_t index = UINT32_MAX;
  };

  static std::size_t place_of(std::string_view text) {
    std::uint64_t key = 0;
    std::memcpy(&key, text.data(), text.size() < sizeof key ? text.size() : sizeof key);
    return static_cast<std::size_t>(key * 0x9e3779b97f4a7c15U >> 58);
  }

  std::array<Slot, 64> slots_{};
  std::unordered_map<std::string_view, std::uint32_t> indices_;
  std::vector<std::string_view> texts_;
};

}  // namespace boule
