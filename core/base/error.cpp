#include "core/base/error.h"

#include <stdexcept>

namespace boule {

std::string printable(std::string_view text, std::size_t longest) {
  constexpr char hex[] = "0123456789abcdef";
  std::string safe;
  for (const char c : text.substr(0, longest)) {
    const auto byte = static_cast<unsigned char>(c);
    if (byte < 0x20 || byte == 0x7f) {
      safe += std::string("\\x") + hex[byte >> 4] + hex[byte & 15];
    } else {
      safe += c;
    }
  }
  if (text.size() > longest) safe += "...";
  return safe;
}

std::string format_diagnostic(const Diagnostic& diagnostic) {
  std::string text;
  if (!diagnostic.file.empty()) {
    text += printable(diagnostic.file) + ":";
    if (diagnostic.line > 0) {
      text += std::to_string(diagnostic.line) + ":";
      if (diagnostic.column > 0) text += std::to_string(diagnostic.column) + ":";
    }
    text += " ";
  }
  text += "error: " + printable(diagnostic.message);
  if (!diagnostic.key.empty()) text += " (key '" + printable(diagnostic.key) + "')";
  return text;
}

std::string quote(std::string_view text, std::size_t longest) {
  return "'" + printable(text, longest) + "'";
}

void throw_text(const Diagnostic& diagnostic) {
  throw std::runtime_error(format_diagnostic(diagnostic));
}

}  // namespace boule
