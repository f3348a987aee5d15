#include "tests/support/run_program.h"

#include <fcntl.h>
#include <poll.h>
#include <sys/syscall.h>
#include <sys/wait.h>
#include <unistd.h>

#include <csignal>
#include <cstdlib>
#include <stdexcept>

#include "tests/support/file_bytes.h"
#include "tests/support/temp_dir.h"

namespace boule::test {
namespace {

/// In the child: redirects its streams to files, sets its environment, becomes the program.
[[noreturn]] void become(const std::string& path, const ProgramCall& call,
                         const std::filesystem::path& folder) {
  const auto redirect = [](const std::filesystem::path& file, int descriptor) {
    const int opened = ::open(file.c_str(), O_WRONLY | O_CREAT | O_TRUNC, 0600);
    if (opened < 0 || ::dup2(opened, descriptor) < 0) ::_exit(125);
  };
  reset_signals();
  ::setpgid(0, 0);  // those that it starts can be killed with it
  redirect(folder / "out", STDOUT_FILENO);
  redirect(folder / "err", STDERR_FILENO);
  for (const std::string& entry : call.environment) {
    const std::size_t equals = entry.find('=');
    ::setenv(entry.substr(0, equals).c_str(), entry.substr(equals + 1).c_str(), 1);
  }
  std::vector<char*> argv = {const_cast<char*>(path.c_str())};
  for (const std::string& argument : call.arguments) {
    argv.push_back(const_cast<char*>(argument.c_str()));
  }
  argv.push_back(nullptr);
  ::execv(path.c_str(), argv.data());
  ::_exit(126);
}

/// Waits for the end of a child, up to the time limit.
int wait_for(pid_t child) {
  constexpr int patience_ms = 15 * 60 * 1000;
  const auto descriptor = static_cast<int>(::syscall(SYS_pidfd_open, child, 0));
  pollfd ended{descriptor, POLLIN, 0};
  if (descriptor >= 0 && ::poll(&ended, 1, patience_ms) == 0) ::kill(-child, SIGKILL);
  if (descriptor >= 0) ::close(descriptor);
  int status = 0;
  ::waitpid(child, &status, 0);
  return status;
}

}  // namespace

void reset_signals() {
  sigset_t ends{};
  sigemptyset(&ends);
  for (const int signal : {SIGINT, SIGTERM, SIGHUP}) {
    std::signal(signal, SIG_DFL);
    sigaddset(&ends, signal);
  }
  ::sigprocmask(SIG_UNBLOCK, &ends, nullptr);
}

ProgramRun run_program(const std::string& path, const ProgramCall& call) {
  const TempDir folder;
  const pid_t child = ::fork();
  if (child < 0) throw std::runtime_error("fork failed");
  if (child == 0) become(path, call, folder.path());
  const int status = wait_for(child);
  ProgramRun run;
  run.exit_code = WIFSIGNALED(status) ? 128 + WTERMSIG(status) : WEXITSTATUS(status);
  run.out = read_bytes(folder.path() / "out");
  run.err = read_bytes(folder.path() / "err");
  return run;
}

}  // namespace boule::test
