#pragma once

#include "core/base/error.h"

namespace boule::cli {

/// The program's exit status; 128 + n means that signal n ended it.
enum ExitCode : int {
  done = 0,
  failed = 1,         ///< rendering or output failed
  wrong_usage = 2,    ///< the command line
  invalid_input = 3,  ///< the scene or a data file
};

/// The exit status of a program that signal n ended.
constexpr ExitCode interrupted_by(int signal) { return static_cast<ExitCode>(128 + signal); }

/// The exit status for an error of reading a scene: options have keys that begin with "--".
inline ExitCode code_of_loading(const Diagnostic& error) {
  return error.key.starts_with("--") ? wrong_usage : invalid_input;
}

}  // namespace boule::cli
