#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "render/frame/measured_picture.h"
#include "render/frame/pixel_rect.h"
#include "render/image/write_image.h"
#include "render/integrators/aovs.h"

namespace boule {

/// The selected AOVs. Their channels, in this order: depth has Z; normal has N.X, N.Y, N.Z;
/// position has P.X, P.Y, P.Z; id has id (uint32); albedo has albedo.R, albedo.G, albedo.B; z has
/// view.Z; noise has noise; samples has samples (uint32). The last two exist where a picture's
/// noise is measured; the others are those of rays through the pixels' centres.
struct AovSelection {
  bool depth = false, normal = false, position = false, id = false, albedo = false, z = false;
  bool noise = false, samples = false;

  /// True if any AOV is selected.
  [[nodiscard]] bool any() const;
  /// True if any is selected that needs rays through the pixels' centres.
  [[nodiscard]] bool any_traced() const;
};

/// One AOV: its name, and the member that selects it.
struct AovName {
  std::string_view name;
  bool AovSelection::*wanted;
};

/// All AOVs.
inline constexpr std::array<AovName, 8> aov_names{{{"depth", &AovSelection::depth},
                                                   {"normal", &AovSelection::normal},
                                                   {"position", &AovSelection::position},
                                                   {"id", &AovSelection::id},
                                                   {"albedo", &AovSelection::albedo},
                                                   {"z", &AovSelection::z},
                                                   {"noise", &AovSelection::noise},
                                                   {"samples", &AovSelection::samples}}};

/// The selected AOVs of every pixel of a picture that need rays of their own, each number in a
/// channel of its own. Two threads may set different pixels in parallel.
class AovChannels {
 public:
  /// For the frame's pixels in `rect`, which is not empty.
  AovChannels(const AovSelection& selection, const PixelRect& rect);

  /// Stores the AOVs of pixel (x, y) of the frame. Preconditions: the pixel lies in `rect`, and
  /// release() is yet to be called.
  void set(int x, int y, const Aovs& aovs);

  /// Moves the channels out, in the order of AovSelection, and leaves none behind.
  std::vector<ImageChannel> release();

  /// The names of all selected channels, in the order of AovSelection.
  static std::vector<std::string> names(const AovSelection& selection);
  /// The number of selected channels that need rays of their own.
  static std::size_t traced(const AovSelection& selection);

  /// The number of bytes of the selected channels of the pixels in `rect`.
  static std::uint64_t bytes(const AovSelection& selection, const PixelRect& rect);

 private:
  PixelRect rect_;
  std::vector<std::size_t> kinds_;  ///< by channel: the number it holds
  std::vector<ImageChannel> channels_;
};

/// The selected channels of a measured picture.
std::vector<ImageChannel> measured_channels(const AovSelection& selection,
                                            const MeasuredPicture& picture);

}  // namespace boule
