#include "render/apps/job/picture/picture_header.h"

#include <fmt/format.h>

#include <cmath>
#include <string>

#include "render/apps/job/options/shown_values.h"
#include "render/apps/job/picture/camera_matrices.h"

namespace boule {

double PartialSamples::percent() const {
  return std::floor(static_cast<double>(done) / static_cast<double>(all) * 1000) / 10;
}

Metadata::value_type PartialSamples::remark() const {
  return {"ImageDescription", fmt::format("partial: {} of {} {}", done, all, what)};
}

PartialSamples samples_of(const PartSheet& sheet, const std::vector<PixelRect>& blocks, int spp) {
  return {sheet.done(), sheet.all(blocks, spp), sheet.kinds().measured ? "pixels" : "samples"};
}

Metadata picture_header(const Renderer& renderer, std::uint64_t scene_hash, const Vec3d& origin,
                        const std::optional<PartialSamples>& partial) {
  const RenderOptions& options = renderer.options();
  const CameraMatrices matrices =
      camera_matrices(renderer.scene().camera, options.width, options.height);
  Metadata header = {{"worldtocamera", matrices.world_to_camera},
                     {"samplesPerPixel", options.spp},
                     {"boule:solver", std::string(name_of(options.solver))},
                     {"boule:method", std::string(name_of(options.method))},
                     {"boule:filter", std::string(name_of(options.filter))},
                     {"boule:max_depth", std::to_string(options.max_depth)},
                     {"boule:seed", std::to_string(options.seed)},
                     {"boule:scene_hash", fmt::format("{:016x}", scene_hash)}};
  const bool distorted = renderer.scene().camera_view.distortion.st != nullptr;
  if (matrices.world_to_screen && !distorted)
    header.emplace_back("worldtoscreen", *matrices.world_to_screen);
  if (options.aovs.position && !(origin == Vec3d{}))
    header.emplace_back("boule:origin", fmt::format("{} {} {}", origin.x, origin.y, origin.z));
  if (options.noise > 0) {
    header.emplace_back("boule:noise", fmt::format("{}", options.noise));
    header.emplace_back("boule:min_spp", options.min_spp);
  }
  if (options.aa > 0) header.emplace_back("boule:aa", fmt::format("{}", options.aa));
  if (options.least_weight > 0)
    header.emplace_back("boule:least_weight", fmt::format("{}", options.least_weight));
  if (partial) header.push_back(partial->remark());
  return header;
}

Metadata resolution_header(const SizeChoice& size) {
  if (!size.is_printed()) return {};
  const auto dpi = static_cast<float>(size.pixels_per_inch());
  return {{"XResolution", dpi}, {"YResolution", dpi}, {"ResolutionUnit", std::string("in")}};
}

Metadata noise_header(const NoiseReached& reached) {
  return {{"boule:noise_reached", static_cast<float>(reached.half_width)},
          {"boule:mean_samples", static_cast<float>(reached.mean_samples)},
          {"boule:settled", static_cast<float>(reached.share)}};
}

}  // namespace boule
