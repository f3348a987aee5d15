#include "render/files/file/sphere_room.h"

#include <algorithm>

#include "core/base/memory_pages.h"

namespace boule {

void make_room(std::vector<Sphere>& spheres, std::size_t more) {
  const std::size_t needed = spheres.size() + more;
  if (needed <= spheres.capacity()) return;
  std::vector<Sphere> roomy;
  roomy.reserve(std::max(needed, spheres.capacity() + spheres.capacity() / 2));
  prefer_huge_pages(roomy.data(), roomy.capacity() * sizeof(Sphere));
  roomy.assign(spheres.begin(), spheres.end());
  spheres.swap(roomy);
}

void append_blank(std::vector<Sphere>& spheres, std::size_t count,
                  const ParallelFor& parallel_for) {
  make_room(spheres, count);
  touch_pages(spheres.data() + spheres.size(), count * sizeof(Sphere), parallel_for);
  spheres.resize(spheres.size() + count);
}

}  // namespace boule
