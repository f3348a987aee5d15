#include "tests/render/apps/cli/running_program.h"

#include <fcntl.h>
#include <gtest/gtest.h>
#include <poll.h>
#include <pty.h>
#include <signal.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <cstdlib>
#include <stdexcept>

namespace boule::test {
namespace {

/// What nothing here takes on the slowest of machines; what does has come to a standstill.
constexpr std::chrono::minutes patience{2};

void add_to_environment(const std::string& entry) {
  const std::size_t equals = entry.find('=');
  ::setenv(entry.substr(0, equals).c_str(), entry.substr(equals + 1).c_str(), 1);
}

/// ":" and what the variable holds, if it is set.
std::string and_what_holds(const char* variable) {
  const char* const value = std::getenv(variable);
  return value == nullptr ? "" : ":" + std::string(value);
}

/// What makes the injector hold it there; what is preloaded already stays, and the sanitizer of
/// addresses lets itself be loaded second.
std::vector<std::string> environment_of(const Hold& hold, const std::string& gate) {
  std::vector<std::string> environment = {
      "LD_PRELOAD=" BOULE_HOLD_INJECTOR + and_what_holds("LD_PRELOAD"),
      "ASAN_OPTIONS=verify_asan_link_order=0" + and_what_holds("ASAN_OPTIONS"),
      "BOULE_HOLD_CALL=" + hold.call,
      "BOULE_HOLD_FILE=" + hold.file,
      "BOULE_HOLD_NUMBER=" + std::to_string(hold.number),
      "BOULE_HOLD_AT=" + gate};
  if (!hold.after.empty()) environment.push_back("BOULE_HOLD_AFTER=" + hold.after);
  return environment;
}

}  // namespace

RunningProgram::RunningProgram(const std::vector<std::string>& arguments, unsigned short columns) {
  start(arguments, {}, columns);
}

RunningProgram::RunningProgram(const std::vector<std::string>& arguments, const Hold& hold) {
  if (::mkfifo(gate().c_str(), 0600) != 0) throw std::runtime_error("mkfifo failed");
  start(arguments, environment_of(hold, gate()), 100);
}

void RunningProgram::start(const std::vector<std::string>& arguments,
                           const std::vector<std::string>& environment, unsigned short columns) {
  std::vector<char*> argv = {const_cast<char*>(BOULE_PROGRAM)};
  for (const std::string& argument : arguments) argv.push_back(const_cast<char*>(argument.c_str()));
  argv.push_back(nullptr);
  const winsize size{24, columns, 0, 0};
  child_ = forkpty(&terminal_, nullptr, nullptr, &size);
  if (child_ < 0) throw std::runtime_error("forkpty failed");
  if (child_ == 0) {
    reset_signals();
    for (const std::string& entry : environment) add_to_environment(entry);
    ::execv(argv[0], argv.data());
    ::_exit(126);
  }
}

RunningProgram::~RunningProgram() {
  if (child_ > 0) {
    send(SIGKILL);
    ::waitpid(child_, nullptr, 0);
  }
  ::close(terminal_);
  let_go();
}

void RunningProgram::give_up() {
  ADD_FAILURE() << "waited in vain; shown so far: " << shown_;
  send(SIGKILL);
  ended_ = true;
}

/// False once the program has closed its terminal, and behind the limit.
bool RunningProgram::read_some(Clock::time_point limit, int timeout_ms) {
  if (ended_) return false;
  pollfd waiting{terminal_, POLLIN, 0};
  if (::poll(&waiting, 1, timeout_ms) <= 0) {
    if (Clock::now() > limit) give_up();
    return !ended_;
  }
  std::array<char, 4096> buffer{};
  const ssize_t count = ::read(terminal_, buffer.data(), buffer.size());
  if (count > 0) {
    shown_.append(buffer.data(), static_cast<std::size_t>(count));
  } else {
    ended_ = true;  // a pty without a writer is an input error
  }
  if (!ended_ && Clock::now() > limit) give_up();  // however much it says
  return !ended_;
}

bool RunningProgram::wait_until(
    const std::function<std::size_t(const std::string& shown, std::size_t from)>& condition) {
  const auto limit = Clock::now() + patience;
  std::size_t end = condition(shown_, seen_);
  while (end == std::string::npos && read_some(limit, 10)) end = condition(shown_, seen_);
  if (end == std::string::npos) return false;
  seen_ = end;
  return true;
}

bool RunningProgram::wait_for(const std::string& text) {
  return wait_until([&text](const std::string& shown, std::size_t from) {
    const std::size_t at = shown.find(text, from);
    return at == std::string::npos ? at : at + text.size();
  });
}

bool RunningProgram::wait_for_hold() {
  const auto limit = Clock::now() + patience;
  do {
    gate_ = ::open(gate().c_str(), O_WRONLY | O_NONBLOCK | O_CLOEXEC);  // once it has a reader
  } while (gate_ < 0 && read_some(limit, 1));
  return gate_ >= 0;
}

void RunningProgram::let_go() {
  if (gate_ >= 0) ::close(gate_);
  gate_ = -1;
}

/// To none once it has been waited for: -1 would mean all processes there are.
void RunningProgram::send(int signal) const {
  if (child_ > 0) ::kill(child_, signal);
}

ProgramRun RunningProgram::finish() {
  const auto limit = Clock::now() + patience;
  while (read_some(limit, 1000)) continue;
  int status = 0;
  ::waitpid(child_, &status, 0);
  child_ = -1;
  return {WIFSIGNALED(status) ? 128 + WTERMSIG(status) : WEXITSTATUS(status), shown_, {}};
}

}  // namespace boule::test
