#pragma once

#include <cstdint>
#include <optional>

#include "render/image/write_image.h"
#include "render/renderer/renderer.h"

namespace boule::cli {

/// How many samples an unfinished picture has.
struct PartialSamples {
  std::uint64_t done, all;

  /// Rounded down to a tenth, so that 100 means all.
  [[nodiscard]] double percent() const;
};

/// A picture file's metadata: worldtocamera, worldtoscreen (CameraMatrices),
/// samplesPerPixel, boule:solver, boule:method, boule:filter, boule:max_depth, boule:seed, and
/// boule:scene_hash in 16 hexadecimal digits.
/// None of it depends on ISA, threads or time: equal pictures are equal files.
/// A partial picture has an ImageDescription as well, "partial: 1234 of 5678 samples", which PNG,
/// JPEG and TIFF files can hold too.
Metadata picture_header(const Renderer& renderer, std::uint64_t scene_hash,
                        const std::optional<PartialSamples>& partial = {});

}  // namespace boule::cli
