#include "render/apps/cli/render/claim.h"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <chrono>
#include <memory>
#include <utility>

#include "render/apps/cli/process/file_lock.h"
#include "render/apps/cli/process/file_owner.h"
#include "render/apps/cli/process/time_span.h"
#include "render/image/output_file.h"

namespace boule::cli {
namespace {

constexpr std::chrono::seconds touch_interval{10};

/// An open file, closed at the end unless it is kept.
struct Descriptor {
  int number;
  explicit Descriptor(int open) : number(open) {}
  ~Descriptor() {
    if (number >= 0) close(number);
  }
  Descriptor(const Descriptor&) = delete;
  Descriptor& operator=(const Descriptor&) = delete;
  int keep() { return std::exchange(number, -1); }
};

bool same(const timespec& a, const timespec& b) {
  return a.tv_sec == b.tv_sec && a.tv_nsec == b.tv_nsec;
}

}  // namespace

Claim::Claim(std::string path, int descriptor) : path_(std::move(path)), descriptor_(descriptor) {
  pulse_.emplace([this](Pulse::Clock::time_point now) {
    futimens(descriptor_, nullptr);
    return now + touch_interval;
  });
  pulse_->at(Pulse::Clock::now() + touch_interval);
}

/// A claim that another process took over is not removed.
Claim::~Claim() {
  pulse_.reset();
  const FileOwner owner = FileOwner::parse(small_text(descriptor_)), self = FileOwner::self();
  const bool is_own = owner.process == self.process && owner.processes == self.processes;
  if (is_own && has_name(descriptor_, path_)) unlink(path_.c_str());
  close(descriptor_);
}

Result<std::unique_ptr<Claim>> Claims::take(const std::string& picture) {
  const std::string path = picture + ".claim";
  for (;;) {
    Descriptor made(::open(path.c_str(), O_RDWR | O_CREAT | O_EXCL | O_CLOEXEC, 0666));
    if (made.number >= 0) {
      if (!replace_text(made.number, FileOwner::self().text())) return cannot_write(path, errno);
      struct stat info {};
      if (!first_ && fstat(made.number, &info) == 0) first_ = info.st_mtim;
      return std::unique_ptr<Claim>(new Claim(path, made.keep()));
    }
    if (errno != EEXIST) return cannot_write(path, errno);
    struct stat info {};
    if (stat(path.c_str(), &info) == 0) return take_over(path);
    if (errno != ENOENT) return cannot_write(path, errno);
  }
}

/// Takes a claim whose owner is gone. Two processes that see so at the same time lock the file
/// first, and the second then finds a new owner in it.
Result<std::unique_ptr<Claim>> Claims::take_over(const std::string& path) {
  Descriptor claim(::open(path.c_str(), O_RDWR | O_CLOEXEC | O_NOFOLLOW));
  const auto nobody = [] { return std::unique_ptr<Claim>(); };
  if (claim.number < 0) return nobody();
  if (lock_file(claim.number) != 0 || !has_name(claim.number, path)) return nobody();
  struct stat info {};
  if (fstat(claim.number, &info) != 0) return nobody();
  const FileOwner owner = FileOwner::parse(small_text(claim.number));
  if (!owner.is_gone() && !is_silent(path, info.st_mtim)) return nobody();
  if (!replace_text(claim.number, FileOwner::self().text())) return cannot_write(path, errno);
  return std::unique_ptr<Claim>(new Claim(path, claim.keep()));
}

bool Claims::is_new(const std::string& picture) const {
  struct stat info {};
  if (!first_ || stat(picture.c_str(), &info) != 0 || !S_ISREG(info.st_mode)) return false;
  const timespec& made = info.st_mtim;
  return made.tv_sec != first_->tv_sec ? made.tv_sec > first_->tv_sec
                                       : made.tv_nsec > first_->tv_nsec;
}

/// By this process's own clock: those of other machines and of the file system may differ.
bool Claims::is_silent(const std::string& path, const timespec& touched) {
  const auto now = Pulse::Clock::now();
  const auto [at, is_new] = seen_.try_emplace(path, Sight{touched, now});
  if (is_new || !same(at->second.touched, touched)) at->second = {touched, now};
  return now - at->second.since >= time_span(silence);
}

}  // namespace boule::cli
