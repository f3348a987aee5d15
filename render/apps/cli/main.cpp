#include <cstdlib>
#include <exception>
#include <new>

#include "render/apps/cli/commands/commands.h"
#include "render/apps/cli/process/interrupt.h"
#include "render/apps/cli/process/messages.h"
#include "render/apps/cli/process/own_memory.h"
#include "render/apps/cli/process/standard_streams.h"
#include "render/apps/job/options/option_values.h"
#include "render/files/particle_file/bridge/bridge_reader.h"
#include "render/threads/threads.h"

namespace {

using namespace boule::cli;

struct Run {
  ExitCode operator()(const TextCommand& text) const { return print_as_result(text.text); }
  ExitCode operator()(const UsageError& error) const {
    return report_usage(error.text, error.help);
  }
  template <class Command>
  ExitCode operator()(const Command& command) const {
    return run(command);
  }
};

/// Slurm binds a task to its processors on some clusters only.
void limit_threads_of_task() {
  const char* const processors = std::getenv("SLURM_CPUS_PER_TASK");
  if (processors == nullptr) return;
  if (const auto number = boule::parse_number(processors, 1U, 1U << 20))
    boule::limit_threads(*number);
}

/// The Python that reads files for which Boule has no reader.
void choose_python() {
  const char* const program = std::getenv("BOULE_PYTHON");
  if (program != nullptr && *program != '\0') boule::set_bridge_python(program);
}

ExitCode run_program(int argc, char** argv) {
  try {
    limit_threads_of_task();
    choose_python();
    if (const auto done = take_stack(); !done) return report(done.error(), failed);
    return std::visit(Run{}, parse_command_line(argc, argv));
  } catch (const std::bad_alloc&) {
    leave_without_memory();
  } catch (const std::exception& error) {
    return report(boule::Diagnostic::of(error.what()), failed);
  }
}

}  // namespace

int main(int argc, char** argv) {
  begin_main();
  open_closed_streams();
  install_interrupt_handlers();
  end_program(run_program(argc, argv));
}
