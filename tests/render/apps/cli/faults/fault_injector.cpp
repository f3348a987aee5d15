// Preloaded into the program: lets one call of the system fail, as it may on any day.
//   BOULE_FAULT="CALL NUMBER CODE"  the NUMBER-th call, from 1, fails with errno CODE
//   BOULE_FAULT_HIT=PATH            a file that then appears
//   BOULE_ONLY_NAMED_FILES=1        a file system without O_TMPFILE
// Allocations fail from that one on: where there is no memory there will be none at once. Of
// threads ("thread") there is no room for so many at once, or one of them ("create") fails.
#include <dlfcn.h>
#include <fcntl.h>
#include <pthread.h>
#include <sys/stat.h>
#include <sys/syscall.h>
#include <unistd.h>

#include <atomic>
#include <cerrno>
#include <cstdarg>
#include <cstdio>
#include <cstdlib>
#include <cstring>

extern "C" {
void* __libc_malloc(std::size_t);
void* __libc_calloc(std::size_t, std::size_t);
void* __libc_realloc(void*, std::size_t);
void* __libc_memalign(std::size_t, std::size_t);
}

namespace {

struct Fault {
  char call[16] = {};
  long number = 0;  ///< 0: none
  int code = 0;
};
Fault fault;
std::atomic<long> calls{0};

__attribute__((constructor)) void read_fault() {
  const char* const text = std::getenv("BOULE_FAULT");
  Fault asked;
  if (text != nullptr &&
      std::sscanf(text, "%15s %ld %d", asked.call, &asked.number, &asked.code) == 3)
    fault = asked;
}

void leave_mark() {
  const char* const path = std::getenv("BOULE_FAULT_HIT");
  if (path == nullptr) return;
  const long descriptor = syscall(SYS_openat, AT_FDCWD, path, O_CREAT | O_WRONLY, 0644);
  if (descriptor >= 0) syscall(SYS_close, descriptor);
}

/// Whether the number-th such call is to fail; errno is set then.
bool fails_of(const char* call, long number, bool for_good = true) {
  if (fault.number == 0 || std::strcmp(call, fault.call) != 0) return false;
  if (for_good ? number < fault.number : number != fault.number) return false;
  if (number == fault.number) leave_mark();
  errno = fault.code;
  return true;
}
bool fails(const char* call, bool for_good = false) {
  if (fault.number == 0 || std::strcmp(call, fault.call) != 0) return false;
  return fails_of(call, ++calls, for_good);
}

std::atomic<long> threads{0};

/// A thread, and that it ends.
struct Start {
  void* (*run)(void*);
  void* argument;
};
void* run_counted(void* start) {
  const Start mine = *static_cast<Start*>(start);
  delete static_cast<Start*>(start);
  void* const result = mine.run(mine.argument);
  --threads;
  return result;
}

}  // namespace

extern "C" {

int open(const char* path, int flags, ...) {
  va_list rest;
  va_start(rest, flags);
  const int mode = (flags & (O_CREAT | O_TMPFILE)) != 0 ? va_arg(rest, int) : 0;
  va_end(rest);
  if ((flags & O_TMPFILE) == O_TMPFILE && std::getenv("BOULE_ONLY_NAMED_FILES") != nullptr) {
    errno = EOPNOTSUPP;
    return -1;
  }
  if (fails("open")) return -1;
  return static_cast<int>(syscall(SYS_openat, AT_FDCWD, path, flags, mode));
}
int open64(const char* path, int flags, ...) {
  va_list rest;
  va_start(rest, flags);
  const int mode = (flags & (O_CREAT | O_TMPFILE)) != 0 ? va_arg(rest, int) : 0;
  va_end(rest);
  return open(path, flags, mode);
}
ssize_t read(int descriptor, void* bytes, std::size_t count) {
  if (fails("read")) return -1;
  return syscall(SYS_read, descriptor, bytes, count);
}
/// What they become where the compiler knows the buffer (_FORTIFY_SOURCE).
ssize_t __read_chk(int descriptor, void* bytes, std::size_t count, std::size_t) {
  return read(descriptor, bytes, count);
}
int __open_2(const char* path, int flags) { return open(path, flags); }
int __open64_2(const char* path, int flags) { return open(path, flags); }
/// What the user is told does not count.
ssize_t write(int descriptor, const void* bytes, std::size_t count) {
  if (descriptor > 2 && fails("write")) return -1;
  return syscall(SYS_write, descriptor, bytes, count);
}
/// A file whose close() fails is closed all the same.
int close(int descriptor) {
  const auto result = static_cast<int>(syscall(SYS_close, descriptor));
  return fails("close") ? -1 : result;
}
int fsync(int descriptor) {
  return fails("fsync") ? -1 : static_cast<int>(syscall(SYS_fsync, descriptor));
}
int rename(const char* from, const char* to) {
  return fails("rename") ? -1 : static_cast<int>(syscall(SYS_rename, from, to));
}
int linkat(int from, const char* old, int to, const char* name, int flags) {
  return fails("linkat") ? -1 : static_cast<int>(syscall(SYS_linkat, from, old, to, name, flags));
}
int pthread_create(pthread_t* thread, const pthread_attr_t* attributes, void* (*run)(void*),
                   void* argument) {
  static const auto create =
      reinterpret_cast<decltype(&pthread_create)>(dlsym(RTLD_NEXT, "pthread_create"));
  if (!fails_of("thread", ++threads) && !fails("create")) {
    const int code = create(thread, attributes, run_counted, new Start{run, argument});
    if (code != 0) --threads;
    return code;
  }
  --threads;
  return fault.code;
}
ssize_t pwrite(int descriptor, const void* bytes, std::size_t count, off_t offset) {
  return fails("write") ? -1 : syscall(SYS_pwrite64, descriptor, bytes, count, offset);
}
ssize_t pwrite64(int descriptor, const void* bytes, std::size_t count, off_t offset) {
  return pwrite(descriptor, bytes, count, offset);
}
void* malloc(std::size_t size) { return fails("malloc", true) ? nullptr : __libc_malloc(size); }
void* calloc(std::size_t count, std::size_t size) {
  return fails("malloc", true) ? nullptr : __libc_calloc(count, size);
}
void* realloc(void* old, std::size_t size) {
  return fails("malloc", true) ? nullptr : __libc_realloc(old, size);
}
void* aligned_alloc(std::size_t alignment, std::size_t size) {
  return fails("malloc", true) ? nullptr : __libc_memalign(alignment, size);
}
int posix_memalign(void** memory, std::size_t alignment, std::size_t size) {
  if (fails("malloc", true)) return ENOMEM;
  *memory = __libc_memalign(alignment, size);
  return *memory == nullptr ? ENOMEM : 0;
}
}
