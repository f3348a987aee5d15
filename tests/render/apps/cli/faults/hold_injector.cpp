// Preloaded into the program: holds it at one of its calls, until it is let go or a signal ends it.
//   BOULE_HOLD_CALL=CALL   open, read, write: of a file whose path begins with BOULE_HOLD_FILE,
//                          before the call; thread: the main thread starts another, likewise;
//                          say: a text with BOULE_HOLD_FILE in it on standard error, after the call
//   BOULE_HOLD_NUMBER=N    the N-th such call, from 1
//   BOULE_HOLD_AFTER=TEXT  counted from when this was said on standard error; if set
//   BOULE_HOLD_AT=FIFO     is read then, until nobody has it open for writing any more
#include <dlfcn.h>
#include <fcntl.h>
#include <pthread.h>
#include <sys/syscall.h>
#include <unistd.h>

#include <atomic>
#include <cerrno>
#include <climits>
#include <cstdarg>
#include <cstdio>
#include <cstdlib>
#include <cstring>

namespace {

// Of the environment as it was at the start.
const char *call_to_hold = "", *file_to_hold = "", *text_before = nullptr, *fifo = "";
long number_to_hold = 0;  ///< 0: none
std::atomic<long> calls{0};
std::atomic<bool> counting{false};

__attribute__((constructor)) void read_hold() {
  const char* const call = std::getenv("BOULE_HOLD_CALL");
  const char* const number = std::getenv("BOULE_HOLD_NUMBER");
  const char* const file = std::getenv("BOULE_HOLD_FILE");
  const char* const at = std::getenv("BOULE_HOLD_AT");
  if (call == nullptr || number == nullptr || file == nullptr || at == nullptr) return;
  call_to_hold = call;
  file_to_hold = file;
  fifo = at;
  text_before = std::getenv("BOULE_HOLD_AFTER");
  counting = text_before == nullptr;
  number_to_hold = std::atol(number);
}

/// Signals' handlers run meanwhile.
void hold() {
  const int saved = errno;
  long pipe = -1;
  do pipe = syscall(SYS_openat, AT_FDCWD, fifo, O_RDONLY | O_CLOEXEC);
  while (pipe < 0 && errno == EINTR);
  char byte = 0;
  long got = 0;
  do got = syscall(SYS_read, pipe, &byte, 1);
  while (got > 0 || (got < 0 && errno == EINTR));
  syscall(SYS_close, pipe);
  errno = saved;
}

bool is_held(const char* call) {
  return number_to_hold > 0 && counting && std::strcmp(call, call_to_hold) == 0;
}
void count() {
  if (++calls == number_to_hold) hold();
}

void at_path(const char* call, const char* path) {
  if (is_held(call) && std::strncmp(path, file_to_hold, std::strlen(file_to_hold)) == 0) count();
}
void at_descriptor(const char* call, int descriptor) {
  if (!is_held(call)) return;
  char link[64] = "", path[PATH_MAX] = "";
  std::snprintf(link, sizeof link, "/proc/self/fd/%d", descriptor);
  if (syscall(SYS_readlinkat, AT_FDCWD, link, path, sizeof path - 1) > 0) at_path(call, path);
}

/// Of a text on standard error, after it was written there.
void at_text(const void* bytes, std::size_t count_of_bytes) {
  if (number_to_hold == 0) return;
  const auto holds = [&](const char* text) {
    return memmem(bytes, count_of_bytes, text, std::strlen(text)) != nullptr;
  };
  if (is_held("say") && holds(file_to_hold)) count();
  if (text_before != nullptr && holds(text_before)) counting = true;
}

template <class Function>
Function* next(const char* name) {
  return reinterpret_cast<Function*>(dlsym(RTLD_NEXT, name));
}

}  // namespace

extern "C" {

int open(const char* path, int flags, ...) {
  static const auto real = next<int(const char*, int, ...)>("open");
  va_list rest;
  va_start(rest, flags);
  const int mode = (flags & (O_CREAT | O_TMPFILE)) != 0 ? va_arg(rest, int) : 0;
  va_end(rest);
  at_path("open", path);
  return real(path, flags, mode);
}
ssize_t read(int descriptor, void* bytes, std::size_t count) {
  static const auto real = next<ssize_t(int, void*, std::size_t)>("read");
  at_descriptor("read", descriptor);
  return real(descriptor, bytes, count);
}
ssize_t write(int descriptor, const void* bytes, std::size_t count) {
  static const auto real = next<ssize_t(int, const void*, std::size_t)>("write");
  at_descriptor("write", descriptor);
  const ssize_t written = real(descriptor, bytes, count);
  if (descriptor == STDERR_FILENO) at_text(bytes, count);
  return written;
}
ssize_t pwrite64(int descriptor, const void* bytes, std::size_t count, off_t offset) {
  static const auto real = next<ssize_t(int, const void*, std::size_t, off_t)>("pwrite64");
  at_descriptor("write", descriptor);
  return real(descriptor, bytes, count, offset);
}
ssize_t pwrite(int descriptor, const void* bytes, std::size_t count, off_t offset) {
  return pwrite64(descriptor, bytes, count, offset);
}
/// What the calls above become where the compiler knows the buffer (_FORTIFY_SOURCE).
ssize_t __read_chk(int descriptor, void* bytes, std::size_t count, std::size_t) {
  return read(descriptor, bytes, count);
}
int __open_2(const char* path, int flags) { return open(path, flags); }

int pthread_create(pthread_t* thread, const pthread_attr_t* attributes, void* (*run)(void*),
                   void* argument) {
  static const auto real =
      next<int(pthread_t*, const pthread_attr_t*, void* (*)(void*), void*)>("pthread_create");
  if (is_held("thread") && ::gettid() == ::getpid()) count();
  return real(thread, attributes, run, argument);
}
}
