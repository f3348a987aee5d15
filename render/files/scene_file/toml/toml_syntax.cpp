#include "render/files/scene_file/toml/toml_syntax.h"

#include <algorithm>
#include <cstddef>
#include <map>

#include "core/base/text.h"
#include "render/files/file/nearest_name.h"

namespace boule {
namespace {

constexpr int most_key_parts = 32, most_values = 1024;

/// Cuts the first line off `rest`.
std::string_view take_line(std::string_view& rest) {
  const std::size_t end = std::min(rest.find('\n'), rest.size());
  const std::string_view line = rest.substr(0, end);
  rest.remove_prefix(std::min(end + 1, rest.size()));
  return line;
}

/// The name inside "[name]" or "[[name]]", or nothing.
std::string_view header_name(std::string_view line) {
  if (line.substr(0, 1) != "[") return {};
  line.remove_prefix(line.substr(0, 2) == "[[" ? 2 : 1);
  return without_blanks(line.substr(0, line.find(']')));
}

/// Where the string that begins at `from` ends: behind its closing quote, or at the line's end.
std::size_t skip_string(std::string_view text, std::size_t from) {
  const char mark = text[from];
  for (std::size_t i = from + 1; i < text.size() && text[i] != '\n'; ++i) {
    if (text[i] == mark) return i + 1;
    if (text[i] == '\\' && mark == '"') ++i;
  }
  return std::min(text.find('\n', from), text.size());
}

/// The fault of a string that begins at `from`, or nullptr. toml++ reads a string that follows a
/// bare value without a blank as part of the value.
const char* string_fault(std::string_view text, std::size_t from) {
  constexpr std::string_view before = " \t\r\n=[{,.";
  if (from > 0 && before.find(text[from - 1]) == std::string_view::npos) {
    return "a string cannot begin here";
  }
  const std::string three(3, text[from]);
  return text.substr(from, 3) == three ? "multi-line strings are not supported" : nullptr;
}

TextPlace place_at(std::string_view text, std::size_t offset) {
  const std::string_view before = text.substr(0, offset);
  const std::size_t line_start = before.rfind('\n') + 1;  // npos + 1 is 0: the first line
  return {1 + static_cast<int>(std::count(before.begin(), before.end(), '\n')),
          1 + static_cast<int>(offset - line_start)};
}

}  // namespace

Status refuse_untrusted(std::string_view text, const std::string& file) {
  int parts = 1, values = 1;
  const char* fault = nullptr;
  std::size_t i = 0;
  while (i < text.size()) {
    const char c = text[i];
    const bool is_string = c == '"' || c == '\'';
    if (is_string) fault = string_fault(text, i);
    if (static_cast<unsigned char>(c) >= 0x7f)
      fault = "only strings and comments may hold such a character";
    // A number has at most one dot before the next of these characters: only keys have more.
    if (c == '\n' || c == '=' || c == ',' || c == '[' || c == '{') parts = 1;
    if (c == '=' || c == '{' || c == '}') values = 1;  // the number of tables is not limited
    if (c == ',' && ++values > most_values) fault = "an array has at most 1024 values";
    if (c == '.' && ++parts > most_key_parts) fault = "a key has at most 32 dotted parts";
    if (fault != nullptr) break;
    if (is_string) {
      i = skip_string(text, i);
    } else {
      i = c == '#' ? std::min(text.find('\n', i), text.size()) : i + 1;
    }
  }
  if (fault == nullptr) return {};
  const TextPlace place = place_at(text, i);
  return Diagnostic{.message = fault,
                    .key = key_on_line(text, place.line),
                    .file = file,
                    .line = place.line,
                    .column = place.column};
}

std::string key_on_line(std::string_view text, int line) {
  std::map<std::string_view, int> seen;  // how often each [[name]] came
  std::string header;
  for (int number = 1; number <= line && !text.empty(); ++number) {
    const std::string_view shown = without_blanks(take_line(text));
    const std::string_view name = header_name(shown);
    if (!name.empty()) {
      header = safe_name(name);
      if (shown.substr(0, 2) == "[[") header += "[" + std::to_string(seen[name]++) + "]";
      if (number == line) return header;
    }
    const std::size_t equals = shown.find('=');
    if (number < line || equals == std::string_view::npos) continue;
    const std::string key = safe_name(without_blanks(shown.substr(0, equals)));
    return header.empty() ? key : header + "." + key;
  }
  return "";
}

TextPlace literal_place(std::string_view text, TextPlace reported, std::string_view description) {
  const std::size_t open = description.find('\'');
  const std::size_t close = description.rfind('\'');
  if (open == std::string_view::npos || close <= open + 1) return reported;
  const std::string_view literal = description.substr(open + 1, close - open - 1);
  std::string_view line;
  for (int number = 1; number <= reported.line; ++number) line = take_line(text);
  const std::size_t behind = static_cast<std::size_t>(reported.column) - 1;
  if (behind < literal.size() || behind > line.size()) return reported;
  const std::size_t start = behind - literal.size();
  if (line.substr(start, literal.size()) != literal) return reported;
  return {reported.line, static_cast<int>(start) + 1};
}

std::string without_prefix(std::string_view text, std::string_view prefix) {
  if (text.substr(0, prefix.size()) == prefix) text.remove_prefix(prefix.size());
  return std::string(text);
}

}  // namespace boule
