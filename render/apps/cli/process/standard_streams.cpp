#include "render/apps/cli/process/standard_streams.h"

#include <fcntl.h>
#include <unistd.h>

#include <cerrno>
#include <cstdio>
#include <cstdlib>

/// Every sanitizer brings it.
extern "C" [[gnu::weak]] void __sanitizer_set_death_callback(void (*callback)());  // NOLINT

namespace boule::cli {

void open_closed_streams() {
  for (int stream = STDIN_FILENO; stream <= STDERR_FILENO; ++stream) {
    if (fcntl(stream, F_GETFD) >= 0 || errno != EBADF) continue;
    // Opened for reading, so that writing to it fails as it would to a closed descriptor: no data
    // are lost silently. open() returns the lowest free descriptor, which is this one. The folder
    // serves where there is no /dev.
    if (open("/dev/null", O_RDONLY) < 0) open("/", O_RDONLY);
  }
}

void end_program(int code) {
  if (__sanitizer_set_death_callback != nullptr) std::exit(code);
  std::fflush(nullptr);
  ::_exit(code);
}

}  // namespace boule::cli
