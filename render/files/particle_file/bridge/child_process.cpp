#include "render/files/particle_file/bridge/child_process.h"

#include <fcntl.h>
#include <poll.h>
#include <spawn.h>
#include <sys/socket.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <csignal>
#include <cstring>
#include <system_error>
#include <utility>

#include "core/base/text.h"

namespace boule {
namespace {

std::string reason_of(int code) { return std::generic_category().message(code); }

void close_end(int& descriptor) {
  if (descriptor >= 0) ::close(std::exchange(descriptor, -1));
}

/// The ends that the program gets as its descriptors 0 to 3; they are closed here.
struct GivenEnds {
  std::array<int, 4> ends{-1, -1, -1, -1};

  GivenEnds() = default;
  GivenEnds(const GivenEnds&) = delete;
  GivenEnds& operator=(const GivenEnds&) = delete;
  ~GivenEnds() {
    for (int& end : ends) close_end(end);
  }

  /// Moves one above those that the program gets: none is overwritten before it is passed on.
  bool take(std::size_t i, int descriptor) {
    constexpr int above = 10;
    ends.at(i) = fcntl(descriptor, F_DUPFD_CLOEXEC, above);
    ::close(descriptor);
    return ends.at(i) >= 0;
  }
};

/// Starts it; an errno code if that fails.
int spawn(const std::vector<std::string>& words, const GivenEnds& given, pid_t& process) {
  std::vector<char*> arguments;
  for (const std::string& word : words) arguments.push_back(const_cast<char*>(word.c_str()));
  arguments.push_back(nullptr);
  posix_spawn_file_actions_t actions;
  posix_spawn_file_actions_init(&actions);
  for (std::size_t i = 0; i < given.ends.size(); ++i) {
    posix_spawn_file_actions_adddup2(&actions, given.ends.at(i), static_cast<int>(i));
  }
  posix_spawnattr_t attributes;
  posix_spawnattr_init(&attributes);
  sigset_t none, all;
  sigemptyset(&none);
  sigfillset(&all);
  posix_spawnattr_setflags(&attributes,
                           POSIX_SPAWN_SETPGROUP | POSIX_SPAWN_SETSIGMASK | POSIX_SPAWN_SETSIGDEF);
  posix_spawnattr_setpgroup(&attributes, 0);
  posix_spawnattr_setsigmask(&attributes, &none);
  posix_spawnattr_setsigdefault(&attributes, &all);
  const int code = posix_spawnp(&process, words.front().c_str(), &actions, &attributes,
                                arguments.data(), environ);
  posix_spawnattr_destroy(&attributes);
  posix_spawn_file_actions_destroy(&actions);
  return code;
}

/// The system kills the group when the other end of this pipe is closed: when this process ends.
void tie_to_group(int lifeline, pid_t process) {
  fcntl(lifeline, F_SETOWN, -process);
  fcntl(lifeline, F_SETSIG, SIGKILL);
  fcntl(lifeline, F_SETFL, fcntl(lifeline, F_GETFL) | O_ASYNC);
}

}  // namespace

Result<std::unique_ptr<ChildProcess>> ChildProcess::start(const std::vector<std::string>& words) {
  std::unique_ptr<ChildProcess> child(new ChildProcess);
  GivenEnds given;
  const auto failed = [] { return Diagnostic::of(reason_of(errno)); };
  std::array<int, 2> pair{};
  if (socketpair(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC, 0, pair.data()) != 0) return failed();
  child->requests_ = pair[1];
  if (!given.take(0, pair[0])) return failed();
  std::size_t next = 1;
  for (int* const mine : {&child->answers_, &child->errors_}) {
    if (pipe2(pair.data(), O_CLOEXEC) != 0) return failed();
    *mine = pair[0];
    if (!given.take(next++, pair[1])) return failed();
  }
  if (pipe2(pair.data(), O_CLOEXEC) != 0) return failed();
  child->lifeline_ = pair[1];
  if (!given.take(next, pair[0])) return failed();
  fcntl(child->answers_, F_SETPIPE_SZ, 1 << 20);  // fewer turns; less is fine
  if (const int code = spawn(words, given, child->process_); code != 0) {
    child->process_ = 0;
    return Diagnostic::of(reason_of(code));
  }
  tie_to_group(given.ends[3], child->process_);
  return child;
}

ChildProcess::~ChildProcess() {
  end();
  for (int* const one : {&requests_, &answers_, &errors_, &lifeline_}) close_end(*one);
}

/// Ends the group. Returns the program's status as waitpid() has it.
int ChildProcess::end() {
  if (process_ == 0) return 0;
  const pid_t process = std::exchange(process_, 0);
  killpg(process, SIGKILL);  // a group without this process
  int status = 0;
  while (waitpid(process, &status, 0) < 0 && errno == EINTR) {
  }
  return status;
}

Status ChildProcess::send(std::string_view text) {
  while (!text.empty()) {
    const ssize_t sent = ::send(requests_, text.data(), text.size(), MSG_NOSIGNAL);
    if (sent < 0 && errno == EINTR) continue;
    if (sent < 0) return ended();
    text.remove_prefix(static_cast<std::size_t>(sent));
  }
  return {};
}

/// Takes what is on standard error. Its last lines are enough.
void ChildProcess::keep_errors() {
  constexpr std::size_t most = 4096;
  std::array<char, most> some{};
  const ssize_t count = ::read(errors_, some.data(), some.size());
  if (count < 0 && errno == EINTR) return;
  if (count <= 0) return close_end(errors_);
  complaints_.append(some.data(), static_cast<std::size_t>(count));
  if (complaints_.size() > most) complaints_.erase(0, complaints_.size() - most);
}

/// Up to `most` bytes; 0 at the end.
Result<std::size_t> ChildProcess::receive(char* to, std::size_t most) {
  for (;;) {
    std::array<pollfd, 2> both{pollfd{answers_, POLLIN, 0}, pollfd{errors_, POLLIN, 0}};
    if (poll(both.data(), both.size(), -1) < 0) {
      if (errno == EINTR) continue;
      return Diagnostic::of(reason_of(errno));
    }
    if (both[1].revents != 0) keep_errors();
    if (both[0].revents == 0) continue;
    const ssize_t count = ::read(answers_, to, most);
    if (count >= 0) return static_cast<std::size_t>(count);
    if (errno != EINTR) return Diagnostic::of(reason_of(errno));
  }
}

/// What is said of a program that ends too early.
Diagnostic ChildProcess::ended() {
  pollfd one{errors_, POLLIN, 0};
  while (errors_ >= 0 && poll(&one, 1, 0) > 0) {
    keep_errors();
    one.fd = errors_;
  }
  const int status = end();
  const auto lines = words_of(complaints_, "\n");
  if (WIFSIGNALED(status) && WTERMSIG(status) != SIGKILL) {
    return Diagnostic::of("it was ended by signal " + std::to_string(WTERMSIG(status)));
  }
  return Diagnostic::of(
      lines.empty() ? "it ended" : "it ended: " + printable(without_blanks(lines.back()), 300));
}

Status ChildProcess::read(void* to, std::size_t bytes) {
  auto* at = static_cast<char*>(to);
  const std::size_t here = std::min(bytes, buffer_.size() - taken_);
  if (here > 0) std::memcpy(at, buffer_.data() + taken_, here);
  taken_ += here;
  for (std::size_t done = here; done < bytes;) {
    const auto count = receive(at + done, bytes - done);
    if (!count) return count.error();
    if (count.value() == 0) return ended();
    done += count.value();
  }
  return {};
}

Result<std::string> ChildProcess::read_line(std::size_t longest) {
  for (;;) {
    const std::size_t end = buffer_.find('\n', taken_);
    if (end != std::string::npos) {
      std::string line = buffer_.substr(taken_, end - taken_);
      taken_ = end + 1;
      return line;
    }
    if (buffer_.size() - taken_ > longest) return Diagnostic::of("its lines have no end");
    if (auto done = fill(); !done) return done.error();
  }
}

/// Receives some more.
Status ChildProcess::fill() {
  constexpr std::size_t some = std::size_t{1} << 16;
  buffer_.erase(0, std::exchange(taken_, 0));
  const std::size_t before = buffer_.size();
  buffer_.resize(before + some);
  const auto count = receive(buffer_.data() + before, some);
  buffer_.resize(before + (count ? count.value() : 0));
  if (!count) return count.error();
  return count.value() > 0 ? Status() : Status(ended());
}

}  // namespace boule
