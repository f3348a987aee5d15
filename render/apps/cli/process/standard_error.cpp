#include "render/apps/cli/process/standard_error.h"

#include <poll.h>
#include <sys/ioctl.h>
#include <unistd.h>

#include <algorithm>
#include <atomic>
#include <cerrno>
#include <csignal>
#include <cstring>
#include <ctime>
#include <mutex>

namespace boule::cli {
namespace {

std::mutex mutex;                    // one writer at a time, but for the last line's
std::size_t drawn = 0;               // under the mutex: length of the line that is open
bool keeping = false;                // under the mutex
std::string kept;                    // under the mutex
std::atomic<bool> line_open{false};  // for the last line, which takes no mutex
std::atomic<bool> writing_line{false};
std::atomic<bool> closed{false};  // the last line has been written, or will be at once
static_assert(std::atomic<bool>::is_always_lock_free);

/// Set on the thread that is writing: a signal's handler on that thread must not wait for it.
thread_local volatile std::sig_atomic_t writing_here = 0;

/// Under the mutex.
void put(const std::string& text) {
  writing_here = 1;
  writing_line = true;
  // An error is not reported, since standard error itself fails; after EINTR it goes on.
  for (std::size_t at = 0; at < text.size() && !closed;) {
    const ssize_t written = ::write(STDERR_FILENO, text.data() + at, text.size() - at);
    if (written < 0 && errno == EINTR) continue;
    if (written <= 0) break;
    at += static_cast<std::size_t>(written);
  }
  writing_line = false;
  writing_here = 0;
}

/// Waits for another thread's line, but only for a while: the terminal may be stopped.
void wait_for_others() {
  constexpr timespec millisecond{0, 1'000'000};
  for (int i = 0; i < 200 && writing_line; ++i) nanosleep(&millisecond, nullptr);
}

}  // namespace

std::size_t terminal_columns() {
  winsize size{};
  const bool told = ioctl(STDERR_FILENO, TIOCGWINSZ, &size) == 0 && size.ws_col > 1;
  return told ? size.ws_col : 80;
}

void write_lines(const std::string& lines) {
  const std::lock_guard lock(mutex);
  if (keeping) {
    kept += lines;
    return;
  }
  if (drawn == 0) return put(lines);
  put("\r" + std::string(drawn, ' ') + "\r" + lines);
  line_open = false;
  drawn = 0;
}

void keep_lines() {
  const std::lock_guard lock(mutex);
  keeping = true;
}

std::string kept_lines() {
  const std::lock_guard lock(mutex);
  return kept;
}

/// What is left of a longer line is blanked.
void draw_line(std::string line) {
  const std::lock_guard lock(mutex);
  line.resize(std::min(line.size(), terminal_columns() - 1));
  const std::size_t length = line.size();
  if (length < drawn) line.append(drawn - length, ' ');
  // Set first: a signal in between then ends a line that is still empty, which does no harm.
  line_open = true;
  put("\r" + line);
  drawn = length;
}

void end_drawn_line() {
  const std::lock_guard lock(mutex);
  if (drawn == 0) return;
  put("\n");
  line_open = false;
  drawn = 0;
}

void write_last_line(const char* line) {
  closed = true;
  if (writing_here == 0) wait_for_others();
  char text[402] = "";
  if (line_open) std::strcat(text, "\n");
  std::strncat(text, line, 400);
  // A full pipe or a stopped terminal would block it for ever.
  constexpr int patience_ms = 200;
  pollfd ready{STDERR_FILENO, POLLOUT, 0};
  if (::poll(&ready, 1, patience_ms) == 0) return;
  [[maybe_unused]] const auto written = ::write(STDERR_FILENO, text, std::strlen(text));
}

}  // namespace boule::cli
