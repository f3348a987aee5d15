#pragma once

#include <pybind11/pybind11.h>

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "render/apps/job/overlay/overlay.h"
#include "render/apps/job/picture/picture_header.h"
#include "render/image/write_image.h"
#include "render/renderer/renderer.h"

namespace boule::python {

/// A picture that was rendered, with all that goes into a file. It does not change.
struct PictureParts {
  Image image;
  std::vector<ImageChannel> channels;
  Metadata header;
  CropWindow crop;
  RenderStatistics statistics;
  std::vector<std::string> notes;
  int spp = 1;
  std::uint64_t scene_hash = 0;
  Vec3d origin{};                         ///< from which the scene counts its points
  OverlayFacts overlay;                   ///< its parts may be empty
  std::optional<NoiseReached> noise;      ///< none: it was not measured
  std::optional<PartialSamples> partial;  ///< none: it is finished
};

/// The picture as Python holds it.
struct Picture {
  std::shared_ptr<const PictureParts> parts;
};

void bind_picture(pybind11::module_& module);

}  // namespace boule::python
