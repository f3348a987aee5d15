#include "render/files/file/sphere_room.h"

#include <algorithm>

#include "core/base/memory_pages.h"

namespace boule {

template <class Primitive>
void make_room(std::vector<Primitive>& primitives, std::size_t more) {
  const std::size_t needed = primitives.size() + more;
  if (needed <= primitives.capacity()) return;
  std::vector<Primitive> roomy;
  roomy.reserve(std::max(needed, primitives.capacity() + primitives.capacity() / 2));
  prefer_huge_pages(roomy.data(), roomy.capacity() * sizeof(Primitive));
  roomy.assign(primitives.begin(), primitives.end());
  primitives.swap(roomy);
}

template <class Primitive>
void append_blank(std::vector<Primitive>& primitives, std::size_t count,
                  const ParallelFor& parallel_for) {
  make_room(primitives, count);
  touch_pages(primitives.data() + primitives.size(), count * sizeof(Primitive), parallel_for);
  primitives.resize(primitives.size() + count);
}

template void make_room(std::vector<Sphere>&, std::size_t);
template void make_room(std::vector<Capsule>&, std::size_t);
template void append_blank(std::vector<Sphere>&, std::size_t, const ParallelFor&);
template void append_blank(std::vector<Capsule>&, std::size_t, const ParallelFor&);

}  // namespace boule
