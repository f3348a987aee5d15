#pragma once

#include <cstdint>
#include <optional>

#include "render/image/write_image.h"
#include "render/renderer/renderer.h"

namespace boule::cli {

/// How many samples a picture has that was ended early.
struct PartialSamples {
  std::uint64_t done, all;

  /// Rounded down to a tenth: 100 is all.
  [[nodiscard]] double percent() const;
};

/// What a picture's file says about its making: worldtocamera, worldtoscreen (CameraMatrices),
/// samplesPerPixel, boule:solver, boule:method, boule:filter, boule:max_depth, boule:seed, and
/// boule:scene_hash in 16 hexadecimal digits.
/// Nothing of it depends on ISA, threads or time: equal pictures stay equal files.
/// A partial one has an ImageDescription as well, "partial: 1234 of 5678 samples", which PNG, JPEG
/// and TIFF files hold too.
Metadata picture_header(const Renderer& renderer, std::uint64_t scene_hash,
                        const std::optional<PartialSamples>& partial = {});

}  // namespace boule::cli
