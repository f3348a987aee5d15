#pragma once

#include <cstdio>
#include <cstdlib>
#include <string>

#include "core/base/error.h"

namespace boule::fuzz {

/// Ends the program, as a finding, unless `holds`.
inline void require(bool holds, const std::string& what) {
  if (holds) return;
  std::fprintf(stderr, "does not hold: %s\n", what.c_str());
  std::abort();
}

/// Checks what every Diagnostic promises: a printable text of at most three lines that names the
/// file.
inline void require_good(const Diagnostic& error) {
  const std::string text = format_diagnostic(error);
  require(!error.message.empty(), "an error says what is wrong");
  require(!error.file.empty(), "an error names its file: " + text);
  require(error.line >= 0 && error.column >= 0, "places count from 1: " + text);
  int lines = 1;
  for (const char c : text) {
    const auto byte = static_cast<unsigned char>(c);
    require(c == '\n' || (byte >= 0x20 && byte != 0x7f), "no control bytes: " + text);
    lines += c == '\n' ? 1 : 0;
  }
  require(lines <= 3, "three lines at most: " + text);
}

}  // namespace boule::fuzz
