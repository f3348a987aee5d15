#include "render/apps/view/server/access.h"

#include <unistd.h>

#include <algorithm>
#include <array>
#include <charconv>

#include "core/base/text.h"

namespace boule::view {
namespace {

bool is_port(std::string_view text) {
  return !text.empty() && text.size() <= 5 && std::all_of(text.begin(), text.end(), is_digit);
}

/// "1.2.3.4": four numbers below 256. Nothing else that some resolvers take for an address.
bool is_ipv4(std::string_view text) {
  int parts = 0;
  while (true) {
    const std::size_t end = std::min(text.find('.'), text.size());
    const std::string_view part = text.substr(0, end);
    int value = 0;
    if (part.empty() || part.size() > 3 || !std::all_of(part.begin(), part.end(), is_digit))
      return false;
    std::from_chars(part.data(), part.data() + part.size(), value);
    if (value > 255) return false;
    ++parts;
    if (end == text.size()) return parts == 4;
    text.remove_prefix(end + 1);
  }
}

/// "[::1]": between brackets there is never a name.
bool is_ipv6(std::string_view text) {
  if (text.size() < 4 || text.front() != '[' || text.back() != ']') return false;
  text = text.substr(1, text.size() - 2);
  return std::all_of(text.begin(), text.end(), [](char c) {
    return is_digit(c) || (ascii_lower(c) >= 'a' && ascii_lower(c) <= 'f') || c == ':' || c == '.';
  });
}

bool is_localhost(std::string_view text) {
  constexpr std::string_view name = "localhost";
  return std::equal(text.begin(), text.end(), name.begin(), name.end(),
                    [](char a, char b) { return ascii_lower(a) == b; });
}

}  // namespace

Result<std::string> random_token() {
  std::array<unsigned char, 16> bytes{};
  if (::getentropy(bytes.data(), bytes.size()) != 0)
    return Diagnostic::of("the system has no random numbers for a token");
  constexpr std::string_view digits = "0123456789abcdef";
  std::string token;
  for (const unsigned char byte : bytes) {
    token += digits[byte >> 4];
    token += digits[byte & 15];
  }
  return token;
}

bool same_secret(std::string_view a, std::string_view b) {
  if (a.size() != b.size()) return false;
  unsigned char difference = 0;
  for (std::size_t i = 0; i < a.size(); ++i)
    difference |= static_cast<unsigned char>(static_cast<unsigned char>(a[i]) ^
                                             static_cast<unsigned char>(b[i]));
  // The compiler must not see that one difference is enough.
  const volatile unsigned char result = difference;
  return result == 0;
}

bool is_own_host(std::string_view host) {
  const std::size_t colon = host.rfind(':');
  const bool has_port =
      colon != std::string_view::npos && host.find(']', colon) == std::string_view::npos;
  if (has_port && !is_port(host.substr(colon + 1))) return false;
  const std::string_view name = has_port ? host.substr(0, colon) : host;
  return is_ipv4(name) || is_ipv6(name) || is_localhost(name);
}

bool is_own_origin(std::string_view origin, std::string_view host) {
  constexpr std::string_view scheme = "http://";
  return origin.starts_with(scheme) && origin.substr(scheme.size()) == host;
}

Target read_target(std::string_view target) {
  const std::size_t question = std::min(target.find('?'), target.size());
  Target read{target.substr(0, question), {}};
  std::string_view query = target.substr(std::min(question + 1, target.size()));
  constexpr std::string_view key = "token=";
  while (!query.empty()) {
    const std::size_t end = std::min(query.find('&'), query.size());
    const std::string_view part = query.substr(0, end);
    if (part.starts_with(key)) read.token = part.substr(key.size());
    query.remove_prefix(std::min(end + 1, query.size()));
  }
  return read;
}

std::optional<int> picture_number(std::string_view path) {
  constexpr std::string_view folder = "/picture/";
  if (!path.starts_with(folder)) return std::nullopt;
  path.remove_prefix(folder.size());
  int number = 0;
  const auto [end, error] = std::from_chars(path.data(), path.data() + path.size(), number);
  if (path.empty() || !is_digit(path.front()) || error != std::errc{} ||
      end != path.data() + path.size())
    return std::nullopt;
  return number;
}

}  // namespace boule::view
