#include "render/files/particles/select/select_tokens.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>

#include "render/files/particle_file/text/text_number.h"

namespace boule {
namespace {

bool begins_name(char c) { return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || c == '_'; }
bool is_in_name(char c) {
  return begins_name(c) || is_digit(c) || c == '.' || c == ':' || c == '[' || c == ']';
}

/// How many characters of a name `text` begins with.
std::size_t name_size(std::string_view text) {
  if (text.empty() || !begins_name(text.front())) return 0;
  return static_cast<std::size_t>(std::find_if_not(text.begin(), text.end(), is_in_name) -
                                  text.begin());
}

/// The same of "|NAME|".
std::size_t norm_size(std::string_view text) {
  if (!text.starts_with('|')) return 0;
  const std::size_t size = name_size(text.substr(1));
  return size > 0 && text.substr(1 + size).starts_with('|') ? size + 2 : 0;
}

bool begins_number(std::string_view text) {
  if (text.starts_with('-') || text.starts_with('+')) text.remove_prefix(1);
  if (text.starts_with('.')) text.remove_prefix(1);
  return !text.empty() && is_digit(text.front());
}

}  // namespace

Result<SelectToken> SelectTokens::next() {
  while (at_ < text_.size() && (is_blank(text_[at_]) || text_[at_] == '\n')) ++at_;
  const std::string_view rest = text_.substr(at_);
  if (rest.empty()) return token(SelectToken::Kind::end, 0);
  if (begins_number(rest)) return number();
  if (rest.front() == '"' || rest.front() == '\'') return quoted();
  const std::size_t name = std::max(name_size(rest), norm_size(rest));
  return name > 0 ? token(SelectToken::Kind::name, name) : sign();
}

Diagnostic SelectTokens::error(std::size_t place, const std::string& message) const {
  return Diagnostic::about(key_, message + " (character " + std::to_string(place) + ")");
}

SelectToken SelectTokens::token(SelectToken::Kind kind, std::size_t size) {
  const SelectToken made{kind, text_.substr(at_, size), 0, at_ + 1};
  at_ += size;
  return made;
}

Result<SelectToken> SelectTokens::number() {
  const std::string_view rest = text_.substr(at_);
  const std::size_t plus = rest.starts_with('+') ? 1 : 0;
  double value = 0;
  const char* const last = rest.data() + rest.size();
  const auto [end, code] = std::from_chars(rest.data() + plus, last, value);
  auto size = static_cast<std::size_t>(end - rest.data());
  const bool goes_on = end != last && is_in_name(*end);
  while (goes_on && size < rest.size() && is_in_name(rest[size])) ++size;
  SelectToken made = token(SelectToken::Kind::number, size);
  if (goes_on || code != std::errc() || !std::isfinite(value)) {
    return error(made.place, quote(made.text) + " is no number");
  }
  made.number = value;
  return made;
}

Result<SelectToken> SelectTokens::quoted() {
  const std::string_view rest = text_.substr(at_);
  const std::size_t end = rest.find(rest.front(), 1);
  if (end == std::string_view::npos) return error(at_ + 1, "this quotation mark is not closed");
  SelectToken made = token(SelectToken::Kind::text, end + 1);
  made.text = made.text.substr(1, end - 1);
  return made;
}

Result<SelectToken> SelectTokens::sign() {
  constexpr std::array<std::string_view, 11> signs{
      "&&", "||", "==", "!=", "<=", ">=", "<", ">", "!", "(", ")"};
  const std::string_view rest = text_.substr(at_);
  for (const std::string_view sign : signs) {
    if (rest.starts_with(sign)) return token(SelectToken::Kind::sign, sign.size());
  }
  const char first = rest.front();
  const std::string hint = first == '&'   ? ", expected &&"
                           : first == '|' ? ", expected ||"
                           : first == '=' ? ", expected =="
                                          : "";
  std::size_t size = 1;  // with the rest of a character of UTF-8
  while (size < rest.size() && (static_cast<unsigned char>(rest[size]) & 0xc0U) == 0x80) ++size;
  return error(at_ + 1, "found " + quote(rest.substr(0, size)) + hint);
}

}  // namespace boule
