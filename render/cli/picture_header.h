#pragma once

#include <cstdint>

#include "render/image/image_file.h"
#include "render/renderer/renderer.h"

namespace boule::cli {

/// What a picture's file says about its making: worldtocamera, worldtoscreen (CameraMatrices),
/// samplesPerPixel, boule:solver, boule:seed, and boule:scene_hash in 16 hexadecimal digits.
/// Nothing of it depends on ISA, threads or time: equal pictures stay equal files.
Metadata picture_header(const Renderer& renderer, std::uint64_t scene_hash);

}  // namespace boule::cli
