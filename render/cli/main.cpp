#include <exception>

#include "render/cli/commands.h"
#include "render/cli/interrupt.h"
#include "render/cli/messages.h"

namespace {

using namespace boule::cli;

struct Run {
  ExitCode operator()(const TextCommand& text) const { return print_as_result(text.text); }
  ExitCode operator()(const UsageError& error) const { return report_usage(error.text); }
  template <class Command>
  ExitCode operator()(const Command& command) const {
    return run(command);
  }
};

}  // namespace

int main(int argc, char** argv) {
  install_interrupt_handlers();
  try {
    return std::visit(Run{}, parse_command_line(argc, argv));
  } catch (const std::exception& error) {  // out of memory, in practice
    return report({error.what(), {}, {}, 0, 0}, failed);
  }
}
