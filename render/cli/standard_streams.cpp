#include "render/cli/standard_streams.h"

#include <fcntl.h>
#include <unistd.h>

#include <cerrno>
#include <cstdio>
#include <cstdlib>

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
#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
  std::exit(code);
#else
  std::fflush(nullptr);
  ::_exit(code);
#endif
}

}  // namespace boule::cli
