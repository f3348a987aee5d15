#include "render/apps/job/overlay/legend_room.h"

#include "render/apps/job/overlay/overlay_layout.h"
#include "render/apps/job/picture/legend.h"

namespace boule {

void leave_legend_room(const std::optional<OverlayParts>& overlay, const SizeChoice& size,
                       LoadedScene& loaded) {
  Scene& scene = loaded.scene;
  if (scene.camera || scene.fit.room != 0) return;
  OverlayFacts facts = overlay_facts(overlay.value_or(scene.image.overlay), loaded.particles,
                                     colors_of(loaded.particles), std::nullopt);
  facts.pixels_per_point = size.pixels_per_inch() / 72;
  const auto [width, height] = size.of(scene.image);
  scene.fit.room = static_cast<float>(legend_room(facts, width, height, double{scene.fit.margin}));
}

}  // namespace boule
