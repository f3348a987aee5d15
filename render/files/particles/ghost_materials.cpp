#include "render/files/particles/ghost_materials.h"

#include <utility>

#include "render/files/particles/select/particle_select.h"
#include "render/memory/available_memory.h"

namespace boule {

Status make_ghosts(const ParticleFrame& frame, const ParticleStyle& style,
                   ParticleValues<MaterialRef>& materials, const ParallelFor& parallel_for) {
  const std::size_t count = frame.size();
  if (style.ghost.empty() || count == 0) return {};
  if (auto done = check_memory(count * sizeof(MaterialRef), "ghosts need", "ghost"); !done)
    return done;
  const auto selected = select_particles(frame, style.ghost, parallel_for);
  if (!selected) return Diagnostic::about("ghost", selected.error().message);
  ParticleValues<MaterialRef> all;
  all.values.reserve(count);
  for (std::size_t i = 0; i < count; ++i) {
    const MaterialRef own = materials[i];
    const bool is_ghost = selected.value()[i] != 0;
    const std::uint32_t index = is_ghost ? style.ghost_material : own.index();
    all.values.push_back(own.has_color() ? MaterialRef::colored(index, own.color())
                                         : MaterialRef(index));
  }
  materials = std::move(all);
  return {};
}

}  // namespace boule
