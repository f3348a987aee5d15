#include "core/base/error.h"

namespace boule {

std::string format_diagnostic(const Diagnostic& diagnostic) {
  std::string text;
  if (!diagnostic.file.empty()) {
    text += diagnostic.file + ":";
    if (diagnostic.line > 0) {
      text += std::to_string(diagnostic.line) + ":" + std::to_string(diagnostic.column) + ":";
    }
    text += " ";
  }
  text += "error: " + diagnostic.message;
  if (!diagnostic.key.empty()) text += " (key '" + diagnostic.key + "')";
  return text;
}

std::string quote(const std::string& text, std::size_t longest) {
  constexpr char hex[] = "0123456789abcdef";
  std::string safe = "'";
  std::size_t shown = 0;
  for (const char c : text) {
    if (shown++ == longest) {
      safe += "...";
      break;
    }
    const auto byte = static_cast<unsigned char>(c);
    if (byte < 0x20 || byte == 0x7f) {
      safe += std::string("\\x") + hex[byte >> 4] + hex[byte & 15];
    } else {
      safe += c;
    }
  }
  return safe + "'";
}

}  // namespace boule
