#include "render/apps/job/overlay/overlay_facts.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstddef>
#include <set>
#include <utility>

#include "core/base/text.h"
#include "core/math/geometry.h"
#include "render/apps/job/options/option_values.h"
#include "render/apps/job/picture/legend.h"
#include "render/files/file/nearest_name.h"

namespace boule {
namespace {

std::optional<OverlayPart> part_of(const std::string& name) {
  const auto& all = names<OverlayPart>;
  const auto found = std::find(all.begin(), all.end(), name);
  if (found == all.end()) return std::nullopt;
  return static_cast<OverlayPart>(found - all.begin());
}

/// Tables of radii are in angstrom, and so are the files that they are used for.
std::string unit_of(const ParticleFacts& facts) {
  if (auto unit = column_unit(facts.format, "x"); !unit.empty()) return unit;
  const bool is_in_angstrom = facts.radius_source.find("angstrom") != std::string::npos;
  return is_in_angstrom ? "\u00c5" : "";
}

}  // namespace

std::optional<OverlayParts> parse_overlay(const std::string& text) {
  OverlayParts parts;
  if (text == "none") return parts;
  for (const std::string& name : split(text, ',')) {
    const auto part = part_of(name);
    if (!part || std::find(parts.begin(), parts.end(), *part) != parts.end()) return std::nullopt;
    parts.push_back(*part);
  }
  return parts;
}

std::string hint_overlay(const std::string& text) {
  const auto& all = names<OverlayPart>;
  for (const std::string& name : split(text, ',')) {
    if (!part_of(name)) return did_you_mean(name, {all.begin(), all.end()});
  }
  return {};
}

std::string list_overlay_parts() { return joined(names<OverlayPart>, ","); }

bool OverlayFacts::has(OverlayPart part) const {
  return std::find(parts.begin(), parts.end(), part) != parts.end();
}

OverlayFacts overlay_facts(const OverlayParts& parts, const std::vector<ParticleFacts>& particles,
                           std::vector<ParticleColors> colors, const std::optional<double>& frame) {
  OverlayFacts facts;
  facts.parts = parts;
  facts.colors = std::move(colors);
  std::set<std::string> units;
  std::set<double> times;
  for (const ParticleFacts& one : particles) {
    units.insert(unit_of(one));
    if (one.time) times.insert(*one.time);
  }
  if (units.size() == 1) facts.unit = *units.begin();
  if (times.size() == 1) {
    facts.time = fmt::format("t = {:g}", *times.begin());
  } else if (frame) {
    facts.time = fmt::format("frame {:g}", *frame);
  }
  return facts;
}

void add_camera(const Camera& camera, const CameraView& view, int width, OverlayFacts& facts) {
  const double half_width = length(view.right);
  const Vec3d right = view.right * (1 / half_width), up = view.up * (1 / length(view.up));
  const std::array<Vec3d, 3> axes{Vec3d{1, 0, 0}, Vec3d{0, 1, 0}, Vec3d{0, 0, 1}};
  for (std::size_t i = 0; i < 3; ++i)
    facts.axes[i] = {dot(axes[i], right), dot(axes[i], up), -dot(axes[i], view.forward)};
  const double pixels = width / (2 * half_width);
  if (view.kind == CameraKind::orthographic) facts.pixels_per_length = pixels;
  if (view.kind == CameraKind::pinhole || view.kind == CameraKind::thin_lens) {
    const CameraPose& pose =
        std::visit([](const auto& one) -> const CameraPose& { return one.pose; }, camera);
    facts.pixels_per_length = pixels / depth_of(pose, pose.look_at);
  }
}

std::vector<std::string> overlay_notes(const OverlayFacts& facts, const CameraView& view) {
  std::vector<std::string> notes;
  if (facts.has(OverlayPart::legend) && !has_legend(facts.colors))
    notes.emplace_back("no legend: the colours of particles mean neither numbers nor kinds");
  if (facts.has(OverlayPart::time) && facts.time.empty())
    notes.emplace_back("no time: this is no series, and the file has no time");
  if (!facts.has(OverlayPart::scale)) return notes;
  if (!facts.pixels_per_length) {
    notes.emplace_back("no scale bar: this camera bends straight lines");
  } else if (view.kind != CameraKind::orthographic) {
    notes.emplace_back(
        "the scale bar is right at the depth of the point that the camera looks at, the middle of "
        "particles; with --ortho it is right everywhere");
  }
  return notes;
}

}  // namespace boule
