#include "render/apps/cli/process/messages.h"

#include <cerrno>
#include <cstdio>

#include "render/apps/cli/process/interrupt.h"
#include "render/apps/cli/process/standard_error.h"
#include "render/image/output_file.h"

namespace boule::cli {
namespace {

bool has_reader = true;

}  // namespace

Status print_data(const std::string& text) {
  write_lines("");  // ends an open line: both streams may be the same terminal
  const bool written = std::fwrite(text.data(), 1, text.size(), stdout) == text.size();
  if (written && std::fflush(stdout) == 0) return {};
  if (errno != EPIPE) return cannot_write("standard output", errno);
  has_reader = false;
  return {};
}

bool reader_left() { return !has_reader; }

ExitCode print_as_result(const std::string& text) {
  const Status printed = print_data(text);
  if (reader_left()) leave_unread();
  return printed ? done : report(printed.error(), failed);
}

void print_note(const std::string& text) { write_lines(text + "\n"); }

std::string counted(std::size_t count, const std::string& noun) {
  return std::to_string(count) + " " + noun + (count == 1 ? "" : "s");
}

ExitCode report(const Diagnostic& error, ExitCode code) {
  const std::string program = error.file.empty() ? "boule: " : "";
  print_note(program + format_diagnostic(error));
  return code;
}

ExitCode report_usage(const std::string& text, const std::string& help) {
  print_note("boule: error: " + text);
  print_note(help + " shows what it understands");
  return wrong_usage;
}

}  // namespace boule::cli
