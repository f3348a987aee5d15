#include "render/apps/job/overlay/overlay_drawing.h"

#include <cstddef>

namespace boule {
namespace {

/// How many bytes the character at `at` has; 0: it is broken. (RFC 3629, section 4.)
std::size_t character_at(const std::string& text, std::size_t at) {
  const auto byte = [&](std::size_t i) {
    return i < text.size() ? static_cast<unsigned char>(text[i]) : 0U;
  };
  const unsigned first = byte(at), second = byte(at + 1);
  if (first < 0x80) return first < 0x20 || first == 0x7f ? 0 : 1;
  const std::size_t count = first >= 0xf5 ? 0 : first >= 0xf0 ? 4 : first >= 0xe0 ? 3 : 2;
  if (first < 0xc2 || count == 0) return 0;
  for (std::size_t i = 1; i < count; ++i) {
    if ((byte(at + i) & 0xc0U) != 0x80) return 0;
  }
  const bool is_long = (first == 0xe0 && second < 0xa0) || (first == 0xf0 && second < 0x90);
  const bool is_outside = (first == 0xed && second >= 0xa0) || (first == 0xf4 && second >= 0x90);
  return is_long || is_outside ? 0 : count;
}

}  // namespace

std::vector<overlay_module::Item> items_of(const Drawing& drawing) {
  std::vector<overlay_module::Item> items;
  for (const DrawnItem& one : drawing) {
    items.push_back({.shape = one.shape,
                     .points = one.points.data(),
                     .point_count = one.points.size(),
                     .fill = one.fill,
                     .stroke = one.stroke,
                     .width = one.width,
                     .size = one.size,
                     .halo = one.halo,
                     .halo_width = one.halo_width,
                     .text = one.text.c_str(),
                     .colors = one.colors.data(),
                     .color_count = one.colors.size()});
  }
  return items;
}

std::string drawable(const std::string& text) {
  std::string all;
  for (std::size_t at = 0; at < text.size();) {
    const std::size_t count = character_at(text, at);
    count == 0 ? all += '?' : all.append(text, at, count);
    at += count == 0 ? 1 : count;
  }
  return all;
}

}  // namespace boule
