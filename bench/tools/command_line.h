#pragma once

#include <CLI/CLI.hpp>
#include <cstdio>
#include <exception>

namespace boule::bench {

/// Runs a program: add_options(app, arguments) says what its command line may hold, run(arguments)
/// does the work. Returns the exit code: run's; 0 after help was asked for; 2 for bad arguments; 1,
/// with a line about it, where something was thrown.
template <class Arguments, class AddOptions, class Run>
int run_program(const char* about, int argc, char** argv, const AddOptions& add_options,
                const Run& run) {
  try {
    CLI::App app(about);
    Arguments arguments;
    add_options(app, arguments);
    try {
      app.parse(argc, argv);
    } catch (const CLI::ParseError& error) {
      return app.exit(error) == 0 ? 0 : 2;
    }
    return run(arguments);
  } catch (const std::exception& error) {
    std::fprintf(stderr, "%s\n", error.what());
    return 1;
  }
}

}  // namespace boule::bench
