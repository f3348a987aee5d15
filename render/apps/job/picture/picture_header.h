#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "render/apps/job/render_job.h"
#include "render/apps/parts/part_sheet.h"
#include "render/frame/measured_picture.h"
#include "render/frame/pixel_rect.h"
#include "render/image/write_image.h"
#include "render/renderer/renderer.h"

namespace boule {

/// How many samples an unfinished picture has, or how many pixels with all their samples.
struct PartialSamples {
  std::uint64_t done, all;
  const char* what = "samples";  ///< or "pixels"

  /// Rounded down to a tenth, so that 100 means all.
  [[nodiscard]] double percent() const;
  /// The entry of a picture's header.
  [[nodiscard]] Metadata::value_type remark() const;
};

/// Those of these blocks of a sheet, for pictures of so many samples per pixel.
PartialSamples samples_of(const PartSheet& sheet, const std::vector<PixelRect>& blocks, int spp);

/// A picture file's metadata: worldtocamera, worldtoscreen (CameraMatrices),
/// samplesPerPixel, boule:solver, boule:method, boule:filter, boule:max_depth, boule:seed, and
/// boule:scene_hash in 16 hexadecimal digits; boule:noise and boule:min_spp where noise was asked
/// for, and then samplesPerPixel is the most samples; boule:origin, "X Y Z", where there is
/// the AOV `position`, and it is counted from another origin than 0.
/// None of it depends on ISA, threads or time: equal pictures are equal files.
/// A partial picture has an ImageDescription as well, "partial: 1234 of 5678 samples", which PNG,
/// JPEG and TIFF files can hold too.
Metadata picture_header(const Renderer& renderer, std::uint64_t scene_hash, const Vec3d& origin,
                        const std::optional<PartialSamples>& partial = {});

/// What the header says of a picture with so many pixels per inch: XResolution, YResolution and
/// ResolutionUnit, which PNG, TIFF and JPEG files have a place for. None: nothing.
Metadata resolution_header(const SizeChoice& size);

/// What the header says of a measured picture besides: boule:noise_reached, boule:mean_samples and
/// boule:settled (NoiseReached).
Metadata noise_header(const NoiseReached& reached);

}  // namespace boule
