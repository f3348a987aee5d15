#include "render/cli/messages.h"

#include <cstdio>

namespace boule::cli {

void print_data(const std::string& text) { std::fwrite(text.data(), 1, text.size(), stdout); }

void print_note(const std::string& text) { std::fprintf(stderr, "%s\n", text.c_str()); }

ExitCode report(const Diagnostic& error, ExitCode code) {
  const std::string program = error.file.empty() ? "boule: " : "";
  print_note(program + format_diagnostic(error));
  return code;
}

ExitCode report_usage(const std::string& text) {
  print_note("boule: error: " + text);
  print_note("boule --help shows what it understands");
  return wrong_usage;
}

}  // namespace boule::cli
