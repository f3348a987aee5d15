#include "render/files/scene_file/loaded/particle_file_cache.h"

#include <sys/stat.h>

#include <algorithm>
#include <utility>

#include "render/files/file/npz_member.h"

namespace boule {
namespace {

bool are_same(const ParticleFileOptions& a, const ParticleFileOptions& b) {
  return a.format == b.format && a.columns == b.columns && a.water == b.water &&
         a.wanted == b.wanted && a.positive == b.positive && a.lenient == b.lenient &&
         a.most_bonded == b.most_bonded && a.topology == b.topology;
}

}  // namespace

ParticleFileCache::Stamp ParticleFileCache::stamp_of(const std::string& path) {
  const auto in_archive = npz_name(path);
  struct stat status {};
  if (stat((in_archive ? in_archive->file : path).c_str(), &status) != 0) return {};
  return {.device = std::uint64_t{status.st_dev},
          .inode = std::uint64_t{status.st_ino},
          .size = static_cast<std::uint64_t>(status.st_size),
          .seconds = std::int64_t{status.st_mtim.tv_sec},
          .nanoseconds = std::int64_t{status.st_mtim.tv_nsec}};
}

Result<std::shared_ptr<ParticleFile>> ParticleFileCache::open(const std::string& path,
                                                              const ParticleFileOptions& options,
                                                              const ParallelFor& parallel_for) {
  // Taken before the file is read: a change meanwhile is seen the next time.
  const Stamp stamp = stamp_of(path);
  const auto found = std::find_if(entries_.begin(), entries_.end(), [&](const Entry& entry) {
    return entry.path == path && are_same(entry.options, options);
  });
  if (found != entries_.end()) {
    if (found->stamp == stamp && !(stamp == Stamp{})) {
      found->is_used = true;
      return found->file;
    }
    entries_.erase(found);
  }
  auto opened = ParticleFile::open(path, options, parallel_for);
  if (!opened) return opened.error();
  auto file = std::make_shared<ParticleFile>(std::move(opened).value());
  entries_.push_back({path, options, stamp, file});
  return file;
}

void ParticleFileCache::close_unused() {
  std::erase_if(entries_, [](const Entry& entry) { return !entry.is_used; });
  for (Entry& entry : entries_) entry.is_used = false;
}

}  // namespace boule
