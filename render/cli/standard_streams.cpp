#include "render/cli/standard_streams.h"

#include <fcntl.h>
#include <unistd.h>

#include <cerrno>

namespace boule::cli {

void open_closed_streams() {
  for (int stream = STDIN_FILENO; stream <= STDERR_FILENO; ++stream) {
    if (fcntl(stream, F_GETFD) >= 0 || errno != EBADF) continue;
    // For reading: what is written to it fails as it would without it, data are not lost in
    // silence. The lowest free descriptor is the one that is looked for. Without a /dev, a folder.
    if (open("/dev/null", O_RDONLY) < 0) open("/", O_RDONLY);
  }
}

}  // namespace boule::cli
