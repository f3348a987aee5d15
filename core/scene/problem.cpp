#include "core/scene/problem.h"

#include <algorithm>
#include <cmath>

#include "core/scene/background.h"
#include "core/scene/group.h"
#include "core/scene/light.h"
#include "core/scene/material.h"
#include "core/scene/problem_finder.h"
#include "core/scene/scene.h"

namespace boule {
namespace {

/// The number of pixels of an image; 0 if a side is negative.
std::size_t area(int width, int height) {
  return static_cast<std::size_t>(std::max(width, 0)) *
         static_cast<std::size_t>(std::max(height, 0));
}

template <class Variant>
std::optional<Problem> first_problem_of_any(const Variant& one_of) {
  return std::visit([](const auto& kind) { return first_problem(kind); }, one_of);
}

}  // namespace

void check_whole(ProblemFinder& finder, const DistortionMap& map) {
  finder.require("file", map.width >= 2 && map.height >= 2,
                 "must have 2 x 2 pixels or more, has " + std::to_string(map.width) + " x " +
                     std::to_string(map.height));
  finder.require("file", map.st.size() == 2 * area(map.width, map.height),
                 "must have two numbers a pixel");
  finder.require(
      "file", std::all_of(map.st.begin(), map.st.end(), [](float x) { return std::isfinite(x); }),
      "must be finite everywhere");
}

void check_whole(ProblemFinder& finder, const EnvironmentBackground& background) {
  const bool whole = background.width >= 1 && background.height >= 1 &&
                     background.pixels.size() == area(background.width, background.height);
  finder.require("file", whole, "must have width x height pixels, 1 or more");
  const auto good = [](float x) { return std::isfinite(x) && x >= 0; };
  finder.require("file",
                 std::all_of(background.pixels.begin(), background.pixels.end(),
                             [&](const Color& c) { return good(c.r) && good(c.g) && good(c.b); }),
                 "must have finite numbers of 0 or above only");
}

void check_whole(ProblemFinder& finder, const ImageSettings& image) {
  const bool grows = !image.fog_from || !image.fog_to || *image.fog_from < *image.fog_to;
  finder.require("fog_to", grows, "must be above fog_from");
}

std::optional<Problem> find_problem(const Sphere& sphere) { return first_problem(sphere); }
std::optional<Problem> find_problem(const Plane& plane) { return first_problem(plane); }
std::optional<Problem> find_problem(const Capsule& capsule) { return first_problem(capsule); }
std::optional<Problem> find_problem(const Clip& clip) { return first_problem(clip); }
std::optional<Problem> find_problem(const Instance& instance) { return first_problem(instance); }
std::optional<Problem> find_problem(const DistortionMap& map) { return first_problem(map); }
std::optional<Problem> find_problem(const ImageSettings& image) { return first_problem(image); }
std::optional<Problem> find_problem(const RenderSettings& render) { return first_problem(render); }

std::optional<Problem> find_problem(const Material& material) {
  return first_problem_of_any(material);
}
std::optional<Problem> find_problem(const Light& light) { return first_problem_of_any(light); }
std::optional<Problem> find_problem(const Background& background) {
  return first_problem_of_any(background);
}

}  // namespace boule
