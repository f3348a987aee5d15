#include "render/files/particle_file/table/ply_header.h"

#include <algorithm>
#include <array>
#include <utility>

#include "render/files/particle_file/text/text_lines.h"
#include "render/files/particle_file/text/text_number.h"

namespace boule {
namespace {

constexpr std::size_t most_properties = 4096;

struct NamedType {
  std::string_view name;
  PlyType type;
};

std::optional<PlyType> type_of(std::string_view name) {
  using enum BinaryKind;
  constexpr std::array types{
      NamedType{"char", {integer, 1}},  NamedType{"uchar", {unsigned_integer, 1}},
      NamedType{"short", {integer, 2}}, NamedType{"ushort", {unsigned_integer, 2}},
      NamedType{"int", {integer, 4}},   NamedType{"uint", {unsigned_integer, 4}},
      NamedType{"float", {real, 4}},    NamedType{"double", {real, 8}},
      NamedType{"int8", {integer, 1}},  NamedType{"uint8", {unsigned_integer, 1}},
      NamedType{"int16", {integer, 2}}, NamedType{"uint16", {unsigned_integer, 2}},
      NamedType{"int32", {integer, 4}}, NamedType{"uint32", {unsigned_integer, 4}},
      NamedType{"int64", {integer, 8}}, NamedType{"uint64", {unsigned_integer, 8}},
      NamedType{"float32", {real, 4}},  NamedType{"float64", {real, 8}},
  };
  const auto found = std::find_if(types.begin(), types.end(),
                                  [&](const NamedType& type) { return type.name == name; });
  if (found == types.end()) return std::nullopt;
  return found->type;
}

/// Goes through the lines of a header.
class HeaderParser {
 public:
  explicit HeaderParser(std::string_view bytes) : lines_(bytes) {}

  Result<PlyHeader> parse() {
    next_line();
    if (line_text_ != "ply")
      return wrong_line("expected the line 'ply', found " + quote(line_text_));
    while (!lines_.at_end()) {
      next_line();
      if (words_.empty()) continue;
      if (words_.front() == "end_header") return finish();
      if (auto done = read_statement(); !done) return done.error();
    }
    return error_at_line(lines_.line(), "the file ends within the header", "end_header");
  }

 private:
  void next_line() {
    line_ = lines_.line();
    line_text_ = lines_.next();
    words_ = words_of(line_text_);
  }

  [[nodiscard]] Diagnostic wrong_line(std::string message) const {
    return error_at_line(line_, std::move(message), words_.empty() ? "" : std::string(words_[0]));
  }

  [[nodiscard]] Diagnostic wrong_word(std::size_t word, const std::string& expected) const {
    return error_at_word(line_, line_text_, words_[word],
                         "expected " + expected + ", found " + quote(words_[word]),
                         std::string(words_[0]));
  }

  Result<PlyHeader> finish() {
    if (!has_format_) return wrong_line("the header has no line 'format'");
    header_.bytes = lines_.offset();
    header_.lines = lines_.line() - 1;
    return std::move(header_);
  }

  Status read_statement() {
    const std::string_view word = words_.front();
    if (word == "comment" || word == "obj_info") return {};
    if (word == "format") return read_format();
    if (word == "element") return read_element();
    if (word == "property") return read_property();
    return wrong_word(0, "format, element, property, comment, obj_info or end_header");
  }

  Status read_format() {
    constexpr std::array encodings{"ascii", "binary_little_endian", "binary_big_endian"};
    if (has_format_) return wrong_line("a second line 'format'");
    if (words_.size() != 3) return wrong_line("expected 'format ENCODING 1.0'");
    const auto found = std::find(encodings.begin(), encodings.end(), words_[1]);
    if (found == encodings.end()) {
      return wrong_word(1, "ascii, binary_little_endian or binary_big_endian");
    }
    if (words_[2] != "1.0") return wrong_word(2, "version 1.0");
    header_.encoding = static_cast<PlyEncoding>(found - encodings.begin());
    has_format_ = true;
    return {};
  }

  Status read_element() {
    if (words_.size() != 3) return wrong_line("expected 'element NAME COUNT'");
    const auto count = count_in(words_[2]);
    if (!count) return wrong_word(2, "a count");
    const std::string name(words_[1]);
    for (const PlyElement& other : header_.elements) {
      if (other.name == name) return wrong_line("a second element " + quote(name));
    }
    if (header_.elements.size() == most_properties) return wrong_line("more than 4096 elements");
    header_.elements.push_back({name, *count, line_, {}});
    return {};
  }

  Status read_property() {
    if (header_.elements.empty()) return wrong_line("a property before any element");
    const bool is_list = words_.size() > 1 && words_[1] == "list";
    const std::size_t size = is_list ? 5 : 3;
    if (words_.size() != size) {
      return wrong_line("expected 'property TYPE NAME' or 'property list TYPE TYPE NAME'");
    }
    PlyProperty property;
    property.name = words_.back();
    if (is_list) {
      property.count = type_of(words_[2]);
      if (!property.count || property.count->kind == BinaryKind::real) {
        return wrong_word(2, "a type of whole numbers");
      }
    }
    const auto type = type_of(words_[size - 2]);
    if (!type) return wrong_word(size - 2, "a type such as uchar, int or float");
    property.type = *type;
    auto& properties = header_.elements.back().properties;
    if (properties.size() == most_properties) return wrong_line("more than 4096 properties");
    properties.push_back(std::move(property));
    return {};
  }

  TextLines lines_;
  PlyHeader header_;
  bool has_format_ = false;
  std::uint64_t line_ = 1;
  std::string_view line_text_;
  std::vector<std::string_view> words_;
};

}  // namespace

bool PlyElement::has_lists() const {
  return std::any_of(properties.begin(), properties.end(),
                     [](const PlyProperty& property) { return property.count.has_value(); });
}

std::size_t PlyElement::fixed_bytes() const {
  std::size_t bytes = 0;
  for (const PlyProperty& property : properties) {
    bytes += property.count ? property.count->width : property.type.width;
  }
  return bytes;
}

Result<PlyHeader> parse_ply_header(std::string_view bytes) { return HeaderParser(bytes).parse(); }

}  // namespace boule
