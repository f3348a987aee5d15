#pragma once

#include <sys/types.h>

#include <cstddef>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "core/base/error.h"

namespace boule {

/// Another program that answers requests: its standard input and output lead here, and what it
/// writes to standard error is kept for messages. It is the leader of its own group of processes,
/// which ends with this object, and with this process, however that ends. For one thread at a time.
class ChildProcess {
 public:
  /// Starts the program `words[0]`, found by PATH, with these arguments. The error has the system's
  /// reason.
  static Result<std::unique_ptr<ChildProcess>> start(const std::vector<std::string>& words);

  ChildProcess(const ChildProcess&) = delete;
  ChildProcess& operator=(const ChildProcess&) = delete;
  ~ChildProcess();

  /// Sends a text. An error if the program does not take it.
  Status send(std::string_view text);

  /// The next bytes that it writes. An error where it ends before, with the last line of its
  /// errors.
  Status read(void* to, std::size_t bytes);
  /// The next line, without its end. An error for one of more than `longest` bytes, too.
  Result<std::string> read_line(std::size_t longest);

 private:
  ChildProcess() = default;
  Result<std::size_t> receive(char* to, std::size_t most);
  Status fill();
  void keep_errors();
  int end();
  Diagnostic ended();

  pid_t process_ = 0;               ///< 0: it has ended
  int requests_ = -1;               ///< a socket: it gives no SIGPIPE
  int answers_ = -1, errors_ = -1;  ///< pipes
  int lifeline_ = -1;               ///< where this end is closed, the system kills the group
  std::string complaints_;          ///< the end of what it wrote to standard error
  std::string buffer_;              ///< what was received
  std::size_t taken_ = 0;           ///< of that
};

}  // namespace boule
