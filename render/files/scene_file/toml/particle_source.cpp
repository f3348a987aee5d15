#include "render/files/scene_file/toml/particle_source.h"

#include <algorithm>

namespace boule {

Status ParticleSource::seek(std::uint64_t sphere) {
  next_ = sphere;
  return {};
}

/// No part is kept: those that are asked for begin with one, but for the first of a chunk.
Status ParticleSource::read(std::vector<Sphere>& part, std::size_t most) {
  part.clear();
  if (next_ >= spheres_->size()) return {};
  const auto [index, first] = spheres_->part_of(next_);
  if (auto done = spheres_->read(index, origin_, part, parallel_for_); !done) return done;
  part.erase(part.begin(), part.begin() + static_cast<std::ptrdiff_t>(next_ - first));
  part.resize(std::min(part.size(), most));
  next_ += part.size();
  return {};
}

}  // namespace boule
