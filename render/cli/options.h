#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <variant>

#include "render/frame/pixel_order.h"
#include "render/frame/pixel_rect.h"
#include "render/image/image_file.h"
#include "render/scene_file/scene_file.h"
#include "simd/abi/isa.h"

namespace boule::cli {

/// Width and height in pixels.
struct Size {
  int width, height;
};

/// `boule render`: what is not given comes from the scene.
struct RenderCommand {
  std::string scene;
  std::string output;
  std::optional<Size> size;
  std::optional<int> spp;
  std::optional<int> max_depth;
  std::optional<PixelRect> crop;
  std::uint64_t seed = 0;
  int tile = 16;
  PixelOrder order = PixelOrder::tiles;
  unsigned threads = 0;
  std::string isa = "auto";
  Solver solver = Solver::robust;
  Compression compression = Compression::zip;
  float exposure_stops = 0;
  PolygonPolicy polygons = PolygonPolicy::plane;
  bool quiet = false;
};

/// `boule isa`.
struct IsaCommand {
  bool json = false;
};

/// Text to print instead of doing anything: the help, the version.
struct TextCommand {
  std::string text;
};

/// A command line that is none, and why.
struct UsageError {
  std::string text;
};

using Command = std::variant<RenderCommand, IsaCommand, TextCommand, UsageError>;

/// What the command line asks for.
Command parse_command_line(int argc, const char* const* argv);

}  // namespace boule::cli
