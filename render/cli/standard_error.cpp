#include "render/cli/standard_error.h"

#include <sys/ioctl.h>
#include <unistd.h>

#include <algorithm>
#include <atomic>
#include <csignal>
#include <cstring>
#include <ctime>
#include <mutex>

namespace boule::cli {
namespace {

std::mutex mutex;                    // one writer at a time, but for the last line's
std::size_t drawn = 0;               // under the mutex: length of the line that is open
std::atomic<bool> line_open{false};  // for the last line, which takes no mutex
std::atomic<bool> writing{false};
std::atomic<bool> closed{false};  // the last line has been written, or will be at once
static_assert(std::atomic<bool>::is_always_lock_free);

/// On the thread that is writing: a signal's handler there cannot wait for it.
thread_local volatile std::sig_atomic_t writing_here = 0;

/// Under the mutex.
void put(const std::string& text) {
  writing_here = 1;
  writing = true;
  // Nobody could be told that standard error is gone.
  [[maybe_unused]] ssize_t written = 0;
  if (!closed) written = ::write(STDERR_FILENO, text.data(), text.size());
  writing = false;
  writing_here = 0;
}

/// Waits for another thread's line, but not for ever: the terminal may be stopped.
void wait_for_others() {
  constexpr timespec millisecond{0, 1'000'000};
  for (int i = 0; i < 200 && writing; ++i) nanosleep(&millisecond, nullptr);
}

}  // namespace

std::size_t terminal_columns() {
  winsize size{};
  const bool told = ioctl(STDERR_FILENO, TIOCGWINSZ, &size) == 0 && size.ws_col > 1;
  return told ? size.ws_col : 80;
}

void write_lines(const std::string& lines) {
  const std::lock_guard lock(mutex);
  if (drawn == 0) return put(lines);
  put("\r" + std::string(drawn, ' ') + "\r" + lines);
  line_open = false;
  drawn = 0;
}

/// What is left of a longer line is blanked.
void draw_line(std::string line) {
  const std::lock_guard lock(mutex);
  line.resize(std::min(line.size(), terminal_columns() - 1));
  const std::size_t length = line.size();
  if (length < drawn) line.append(drawn - length, ' ');
  // First: a signal in between then ends an empty line, not none.
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
  [[maybe_unused]] const auto written = ::write(STDERR_FILENO, text, std::strlen(text));
}

}  // namespace boule::cli
