#include "render/apps/cli/process/own_memory.h"

#include <sys/resource.h>

#include <algorithm>
#include <cstddef>
#include <cstdlib>
#include <exception>
#include <new>
#include <string>
#include <system_error>

#include "render/apps/cli/process/exit_code.h"
#include "render/apps/cli/process/interrupt.h"
#include "render/memory/available_memory.h"

namespace boule::cli {
namespace {

constexpr std::size_t kibibyte = 1024;
constexpr std::size_t taken = 3072 * kibibyte, least_limit = 4096 * kibibyte;

/// Touches it from the top, since the stack grows down.
[[gnu::noinline]] void touch_stack() {
  constexpr std::size_t page = 4 * kibibyte;
  [[maybe_unused]] volatile char stack[taken];
  for (std::size_t i = taken; i >= page; i -= page) stack[i - page] = 0;
}

bool started = false;

Diagnostic no_memory() { return Diagnostic::of("out of memory"); }

[[noreturn]] void end_without_thread() {
  leave_at_once("boule: error: a thread cannot be had: Resource temporarily unavailable\n", failed);
}

/// Ends the program with an exception of a library.
[[noreturn]] void end_by(const std::exception& error) {
  leave_at_once(("boule: error: " + std::string(error.what()) + "\n").c_str(), failed);
}

[[noreturn]] void end_without_memory() {
  // No exception: before main() begins there was no memory to throw one; later a thread was not
  // joined because the next one could not be created.
  if (!std::current_exception()) started ? end_without_thread() : leave_without_memory();
  try {
    throw;
  } catch (const std::bad_alloc&) {
    leave_without_memory();
  } catch (const std::system_error& error) {  // a thread, likewise
    if (error.code() == std::errc::resource_unavailable_try_again) end_without_thread();
    end_by(error);
  } catch (const std::exception& error) {
    end_by(error);
  } catch (...) {
    std::abort();
  }
}

/// Runs before sanitizers have begun.
__attribute__((no_sanitize("thread"))) void install_handler() {
  std::set_terminate(end_without_memory);
}

/// Static objects of libraries allocate memory before our first code runs. Functions in this
/// section are called before their constructors.
[[gnu::section(".preinit_array"), gnu::used]] void (*const before_all)() = install_handler;

}  // namespace

Status take_stack() {
  rlimit limit{};
  if (getrlimit(RLIMIT_STACK, &limit) == 0 && limit.rlim_cur < least_limit) {
    limit.rlim_cur = std::min<rlim_t>(limit.rlim_max, least_limit);
    setrlimit(RLIMIT_STACK, &limit);
    if (limit.rlim_cur < least_limit) {
      return Diagnostic::of("the stack is limited to " + std::to_string(limit.rlim_cur / kibibyte) +
                            " KiB (ulimit -s), " + std::to_string(least_limit / kibibyte) +
                            " are needed");
    }
  }
  if (address_room() < least_limit) return no_memory();
  touch_stack();
  return {};
}

void leave_without_memory() { leave_at_once("boule: error: out of memory\n", failed); }

void begin_main() { started = true; }

}  // namespace boule::cli
