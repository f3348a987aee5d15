#include "render/apps/parts/film_text.h"

#include <bit>
#include <charconv>
#include <cstdint>
#include <utility>
#include <vector>

namespace boule {
namespace {

std::string hex(std::uint32_t bits) {
  char digits[8];
  const auto end = std::to_chars(digits, digits + sizeof digits, bits, 16).ptr;
  return {digits, end};
}

bool from_hex(std::string_view text, std::uint32_t& bits) {
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), bits, 16);
  return error == std::errc{} && end == text.data() + text.size();
}

/// What stands before the first `end`, which is taken out of `text` with it.
std::string_view cut(std::string_view& text, char end) {
  const std::size_t at = std::min(text.find(end), text.size());
  const std::string_view front = text.substr(0, at);
  text.remove_prefix(std::min(at + 1, text.size()));
  return front;
}

struct Line {
  std::string& text;
  const std::string& name;

  void add(const char* kind, const std::string& value) const {
    text += std::string(kind) + '\t' + name + '\t' + value + '\n';
  }
  void operator()(const std::string& value) const { add("text", value); }
  void operator()(std::int32_t value) const {
    add("int", hex(std::bit_cast<std::uint32_t>(value)));
  }
  void operator()(float value) const { add("real", hex(std::bit_cast<std::uint32_t>(value))); }
  void operator()(const MetadataMatrix& value) const {
    std::string numbers;
    for (const float number : value)
      numbers += (numbers.empty() ? "" : " ") + hex(std::bit_cast<std::uint32_t>(number));
    add("matrix", numbers);
  }
};

bool read_matrix(std::string_view text, MetadataMatrix& matrix) {
  for (float& number : matrix) {
    std::uint32_t bits = 0;
    if (!from_hex(cut(text, ' '), bits)) return false;
    number = std::bit_cast<float>(bits);
  }
  return text.empty();
}

bool read_entry(std::string_view kind, std::string_view value, MetadataValue& entry) {
  std::uint32_t bits = 0;
  if (kind == "text") {
    entry = std::string(value);
    return true;
  }
  if (kind == "matrix") return read_matrix(value, entry.emplace<MetadataMatrix>());
  if (!from_hex(value, bits)) return false;
  if (kind == "int") {
    entry = std::bit_cast<std::int32_t>(bits);
    return true;
  }
  entry = std::bit_cast<float>(bits);
  return kind == "real";
}

}  // namespace

std::string film_text(const FilmHead& head) {
  std::string text;
  for (const auto& [name, value] : head.facts) Line{text, name}.add("fact", value);
  for (const auto& [name, value] : head.share) Line{text, name}.add("share", value);
  for (const auto& [name, value] : head.metadata) std::visit(Line{text, name}, value);
  return text;
}

bool read_film_text(std::string_view text, FilmHead& head) {
  while (!text.empty()) {
    std::string_view value = cut(text, '\n');
    const std::string_view kind = cut(value, '\t');
    const std::string name(cut(value, '\t'));
    if (kind == "fact" || kind == "share") {
      (kind == "fact" ? head.facts : head.share).emplace_back(name, value);
    } else if (!read_entry(kind, value, head.metadata.emplace_back(name, 0).second)) {
      return false;
    }
  }
  return true;
}

}  // namespace boule
