#include "render/image/module/module_loader.h"

#include <unistd.h>

#include <algorithm>
#include <atomic>
#include <cerrno>
#include <cstdint>
#include <mutex>
#include <string>
#include <string_view>
#include <system_error>

#include "render/image/built_in_table.h"
#include "render/image/module/module_search.h"
#include "render/memory/available_memory.h"
#include "render/threads/threads.h"

namespace boule {
namespace {

/// What is loaded and runs: once per process, like OpenImageIO itself.
struct Loaded {
  std::mutex mutex;
  const image_module::Table* table = nullptr;
  int pool = 0;      ///< threads of OpenImageIO's pool; 0: there is none yet
  int exr_pool = 1;  ///< threads of OpenEXR's pool; 1: there is none
  pid_t owner = 0;   ///< the process that has the pools' threads; 0: there are none
};
Loaded& loaded() {
  static Loaded one;
  return one;
}

/// The process in which a thread holds `loaded()`, or 0.
std::atomic<pid_t> busy{0};

/// Holds `loaded()`. A child that is forked meanwhile would wait for ever, so it can ask `busy`.
class Hold {
 public:
  Hold() : lock_(loaded().mutex) { busy = getpid(); }
  ~Hold() { busy = 0; }
  Hold(const Hold&) = delete;
  Hold& operator=(const Hold&) = delete;

 private:
  const std::lock_guard<std::mutex> lock_;
};

Diagnostic cannot_load(const std::string& reason) {
  return Diagnostic::of("cannot load the image module: " + reason);
}

constexpr unsigned threads_at_load = 4;  // of log4cplus

/// Checks for the memory that loading takes: some of the libraries do not check what malloc
/// returns.
Status check_room() {
  constexpr std::uint64_t mebibyte = 1 << 20;
  // Measured: 405 MiB of addresses, 67 MiB of them writable.
  constexpr std::uint64_t addresses = 440 * mebibyte, data = 80 * mebibyte;
  const std::uint64_t stacks = threads_at_load * std::uint64_t{default_stack()};
  const auto [address_room, data_room] = process_room();
  const auto refuse = [](std::uint64_t needed, std::uint64_t room, const char* limit) {
    return cannot_load("it needs " + std::to_string(needed / mebibyte) + " MiB of memory, " +
                       limit + " leaves " + std::to_string(room / mebibyte));
  };
  if (address_room < addresses + stacks) {
    return refuse(addresses + stacks, address_room, "the limit on addresses (ulimit -v)");
  }
  if (data_room < data + stacks) {
    return refuse(data + stacks, data_room, "the limit on data (ulimit -d)");
  }
  return {};
}

Diagnostic no_threads() { return cannot_load(std::generic_category().message(EAGAIN)); }

Status load(Loaded& one) {
  if (one.table != nullptr) return {};
  if (auto done = check_room(); !done) return done;
  if (!can_start_threads(threads_at_load)) return no_threads();
  const auto opened = open_image_module();
  if (!opened) return cannot_load(opened.error().message);
  one.table = opened.value();
  return {};
}

/// How many threads `start` will start for a file with `threads` threads.
unsigned missing_threads(const Loaded& one, const ImageFormat& format, int threads) {
  const std::string_view writer = format.writer;
  const auto count = static_cast<unsigned>(threads);
  // The pool begins with as many threads as the hardware runs, and is resized then. TIFF uses it in
  // any case.
  const unsigned at_first = one.pool == 0 ? hardware_threads() : 0;
  unsigned missing = 0;
  if (threads > std::max(one.pool, 1))
    missing += std::max(at_first, count);
  else if (writer == "tiff")
    missing += at_first;
  if (writer == "openexr" && threads > one.exr_pool) missing += count;
  return missing;
}

/// Starts the pools for a file with `threads` threads.
Status start(Loaded& one, const ImageFormat& format, int threads) {
  const std::string_view writer = format.writer;
  const unsigned missing = missing_threads(one, format, threads);
  // Rendering will want as many threads at the same time, and some memory to work with.
  constexpr std::uint64_t rest = 32 << 20;
  const unsigned all = missing + static_cast<unsigned>(threads);
  const bool has_room = process_room().data >= all * std::uint64_t{default_stack()} + rest;
  if (missing > 0 && !(has_room && can_start_threads(all))) return no_threads();
  image_module::Report report{};
  one.table->start(format.writer, threads, &report);
  if (report.outcome != image_module::Outcome::done) return cannot_load(report.text);
  if (threads > 1 || writer == "tiff") one.pool = std::max(one.pool, threads);
  if (writer == "openexr") one.exr_pool = std::max(one.exr_pool, threads);
  if (missing > 0) one.owner = getpid();
  return {};
}

/// The module in a forked child. The pools' threads exist in the parent only, and whoever waits for
/// them waits for ever.
Result<LoadedModule> forked(const Loaded& one, const ImageFormat& format) {
  const std::string_view writer = format.writer;
  if ((writer == "openexr" && one.exr_pool > 1) || (writer == "tiff" && one.pool > 0)) {
    return cannot_load(
        std::string("this process was forked from one that had started threads for .") +
        format.extension + " files, which only that one can write and read now");
  }
  image_module::Report report{};
  one.table->start(format.writer, 1, &report);
  return LoadedModule{one.table, 1};
}

}  // namespace

Result<LoadedModule> load_image_module(const ImageFormat& format, int threads) {
  if (const pid_t holder = busy; holder != 0 && holder != getpid()) {
    return cannot_load("this process was forked while another thread loaded it");
  }
  const Hold hold;
  Loaded& one = loaded();
  if (auto done = load(one); !done) return done.error();
  if (one.owner != 0 && one.owner != getpid()) return forked(one, format);
  constexpr int most = 256;
  const int wanted = std::clamp(threads, 1, most);
  const auto started = start(one, format, wanted);
  if (started) return LoadedModule{one.table, wanted};
  if (wanted == 1) return started.error();
  if (auto done = start(one, format, 1); !done) return done.error();
  return LoadedModule{one.table, 1};
}

Result<LoadedModule> load_image_writer(const ImageFormat& format, int threads) {
  if (const auto* const table = built_in_table(format)) return LoadedModule{table, 1};
  return load_image_module(format, threads);
}

}  // namespace boule
