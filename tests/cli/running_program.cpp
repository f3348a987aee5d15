#include "tests/cli/running_program.h"

#include <poll.h>
#include <pty.h>
#include <signal.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <filesystem>
#include <fstream>
#include <sstream>
#include <stdexcept>

namespace boule::test {
namespace {

/// What a file "NUMBER (NAME) ..." of /proc holds after the name, which may hold anything.
std::string after_name(const std::filesystem::path& path) {
  std::ifstream file(path);
  std::string text;
  std::getline(file, text, '\0');
  const std::size_t end = text.rfind(") ");
  return end == std::string::npos ? "" : text.substr(end + 2);
}

}  // namespace

RunningProgram::RunningProgram(const std::vector<std::string>& arguments, unsigned short columns) {
  std::vector<char*> argv = {const_cast<char*>(BOULE_PROGRAM)};
  for (const std::string& argument : arguments) argv.push_back(const_cast<char*>(argument.c_str()));
  argv.push_back(nullptr);
  const winsize size{24, columns, 0, 0};
  child_ = forkpty(&terminal_, nullptr, nullptr, &size);
  if (child_ < 0) throw std::runtime_error("forkpty failed");
  if (child_ == 0) {
    ::execv(argv[0], argv.data());
    ::_exit(126);
  }
}

RunningProgram::~RunningProgram() {
  if (child_ > 0) {
    ::kill(child_, SIGKILL);
    ::waitpid(child_, nullptr, 0);
  }
  ::close(terminal_);
}

/// False once the program has closed its terminal.
bool RunningProgram::read_some(int timeout_ms) {
  pollfd waiting{terminal_, POLLIN, 0};
  if (::poll(&waiting, 1, timeout_ms) <= 0) return true;
  std::array<char, 4096> buffer{};
  const ssize_t count = ::read(terminal_, buffer.data(), buffer.size());
  if (count > 0) {
    shown_.append(buffer.data(), static_cast<std::size_t>(count));
  } else {
    ended_ = true;  // a pty without a writer is an input error
  }
  return !ended_;
}

bool RunningProgram::wait_for(const std::string& text) {
  std::size_t at = shown_.find(text, seen_);
  while (at == std::string::npos && read_some(1000)) at = shown_.find(text, seen_);
  if (at == std::string::npos) at = shown_.find(text, seen_);
  if (at == std::string::npos) return false;
  seen_ = at + text.size();
  return true;
}

bool RunningProgram::has_output(const std::string& folder, std::intmax_t bytes) const {
  std::error_code ended;
  const std::string open_files = "/proc/" + std::to_string(child_) + "/fd";
  for (const auto& entry : std::filesystem::directory_iterator(open_files, ended)) {
    std::error_code closed;
    const std::string name = std::filesystem::read_symlink(entry.path(), closed);
    struct stat file {};
    if (closed || !name.starts_with(folder) || ::stat(entry.path().c_str(), &file) != 0) continue;
    if (S_ISREG(file.st_mode) && file.st_nlink == 0 && file.st_size >= bytes) return true;
  }
  return false;
}

bool RunningProgram::wait_for_output(const std::string& folder, std::intmax_t bytes) {
  while (!ended_) {
    if (has_output(folder, bytes)) return true;
    read_some(1);
  }
  return false;
}

/// Seconds of the processor, so far.
double RunningProgram::work() const {
  // "STATE PARENT ...": the 12th and 13th are ticks.
  std::istringstream fields(after_name("/proc/" + std::to_string(child_) + "/stat"));
  std::string ignored;
  for (int i = 1; i < 12; ++i) fields >> ignored;
  double user = 0, system = 0;
  fields >> user >> system;
  return (user + system) / static_cast<double>(::sysconf(_SC_CLK_TCK));
}

bool RunningProgram::wait_for_work(double seconds) {
  const double end = work() + seconds;
  while (!ended_ && work() < end) read_some(10);
  return !ended_;
}

bool RunningProgram::sleeps() const {
  std::error_code ended;
  const std::string threads = "/proc/" + std::to_string(child_) + "/task";
  for (const auto& thread : std::filesystem::directory_iterator(threads, ended)) {
    if (!after_name(thread.path() / "stat").starts_with('S')) return false;
  }
  return !ended;
}

/// What is kept from running by others does not sleep.
bool RunningProgram::wait_for_sleep() {
  for (int times = 0; times < 20; times = sleeps() ? times + 1 : 0) {
    read_some(10);
    if (ended_) return false;
  }
  return true;
}

void RunningProgram::send(int signal) const { ::kill(child_, signal); }

ProgramRun RunningProgram::finish() {
  while (read_some(1000)) continue;
  int status = 0;
  ::waitpid(child_, &status, 0);
  child_ = -1;
  return {WIFSIGNALED(status) ? 128 + WTERMSIG(status) : WEXITSTATUS(status), shown_, {}};
}

}  // namespace boule::test
