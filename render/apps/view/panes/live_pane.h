#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <vector>

#include "core/base/error.h"
#include "render/frame/film.h"
#include "render/image/image.h"
#include "render/renderer/renderer.h"

namespace boule::view {

/// What a ray through a pixel's centre meets.
struct PixelHit {
  float depth;       ///< from the ray's origin; infinite: nothing
  std::uint32_t id;  ///< of the primitive
};

/// One picture that grows while somebody watches. When it begins anew, what was shown stays until
/// new pixels take its place: that is what makes order frameless frameless, and lets others tear.
class LivePane {
 public:
  /// Begins anew. The scene was prepared for these options.
  Status start(std::shared_ptr<const PreparedScene> scene, const RenderOptions& options);

  /// Renders on for about so long. An error if it was cancelled; then it must begin anew.
  Status step(const StepLimit& limit);

  /// Finds the lines of options.outline, which pictures have from then on. Likewise.
  Status find_outline();

  [[nodiscard]] bool started() const { return renderer_.has_value(); }
  /// Whether all samples are done.
  [[nodiscard]] bool done() const { return renderer_ && renderer_->done(position_); }
  [[nodiscard]] const RenderOptions& options() const { return renderer_->options(); }
  [[nodiscard]] const PreparedScene& scene() const { return renderer_->scene(); }

  /// The picture as it is: the samples so far, and where there are none what was shown before.
  /// Precondition: started().
  [[nodiscard]] Image picture() const;

  /// What the rays through the pixels' centres meet, row by row.
  Result<std::vector<PixelHit>> hits();

  /// Forgets what was shown: the next start() begins with black.
  void forget();

  /// How far it is since it began anew.
  struct Progress {
    std::uint32_t passes = 0;
    std::uint64_t samples = 0, rays = 0;
    double share = 0, seconds = 0;  ///< seconds of rendering
  };
  [[nodiscard]] Progress progress() const;

 private:
  std::optional<Renderer> renderer_;
  std::optional<Film> film_;
  std::optional<Outline> outline_;
  LivePosition position_;
  Image before_;  ///< what was shown when it began anew; of any size
};

}  // namespace boule::view
