#pragma once

#include <string>
#include <vector>

namespace boule::test {

/// How a program ended and what it said.
struct ProgramRun {
  int exit_code = -1;  ///< 128 + n if signal n killed it
  std::string out, err;
};

/// Runs a program with arguments and "NAME=VALUE" additions to the environment, to its end. A
/// program that takes a quarter of an hour hangs: it is killed, with all that it started.
struct ProgramCall {
  std::vector<std::string> arguments;
  std::vector<std::string> environment;
};
ProgramRun run_program(const std::string& path, const ProgramCall& call);

/// For a child before it becomes a program: resets SIGINT, SIGTERM and SIGHUP to end it, which
/// nohup or a shell that runs the tests in the background may have changed.
void reset_signals();

}  // namespace boule::test
