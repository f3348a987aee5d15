#include "render/integrators/chord_lists.h"

#include <algorithm>

namespace boule {

std::size_t ChordLists::find(const KernelTable& kernels, const GeometryView& view,
                             const RayStream& rays, std::size_t first) {
  constexpr std::size_t fewest = 4096;
  ends_.resize(rays.size);
  std::size_t stop = first;
  for (;;) {
    const ChordStream stream{enter_.data(), leave_.data(), id_.data(), slot_.data(), enter_.size()};
    stop = kernels.find_chords(view, rays, first, stream, ends_.data());
    if (stop > first) break;
    const std::size_t more = std::max(fewest, 2 * enter_.size());
    leave_.resize(more);
    id_.resize(more);
    slot_.resize(more);
    enter_.resize(more);
  }
  chords_.resize(ends_[stop - 1]);
  for (std::size_t i = 0; i < chords_.size(); ++i)
    chords_[i] = {enter_[i], leave_[i], id_[i], slot_[i]};
  return stop;
}

}  // namespace boule
