#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <atomic>
#include <cstddef>
#include <cstdint>
#include <string>
#include <thread>
#include <utility>
#include <vector>

#include "core/base/error.h"
#include "core/base/parallel.h"
#include "core/scene/primitive.h"
#include "render/files/particle_file/frame/particle_frame.h"
#include "render/files/particles/particle_spheres.h"

namespace boule::test {

/// Texts as a column of a frame.
inline TextColumn text_column(const std::string& name, const std::vector<std::string>& values) {
  TextColumn column{name, {}, {}};
  for (const std::string& value : values) {
    const auto found = std::find(column.texts.begin(), column.texts.end(), value);
    column.indices.push_back(static_cast<std::uint32_t>(found - column.texts.begin()));
    if (found == column.texts.end()) column.texts.push_back(value);
  }
  return column;
}

/// Particles on the x axis, 1 apart, the first at 0.
inline ParticleFrame row_of_particles(std::size_t count) {
  ParticleFrame frame;
  for (std::size_t i = 0; i < count; ++i) frame.positions.push_back({static_cast<double>(i), 0, 0});
  return frame;
}

/// The same with species.
inline ParticleFrame row_of(const std::vector<std::string>& species) {
  ParticleFrame frame = row_of_particles(species.size());
  frame.species = text_column("species", species);
  return frame;
}

/// Calls the bodies on so many threads, in an order that differs from run to run.
inline ParallelFor threaded_for(std::size_t threads) {
  return [threads](std::size_t count, const std::function<void(std::size_t)>& body) {
    std::atomic<std::size_t> next{0};
    std::vector<std::thread> running;
    for (std::size_t i = 0; i < threads; ++i) {
      running.emplace_back([&] {
        for (std::size_t k = next++; k < count; k = next++) body(count - 1 - k);
      });
    }
    for (std::thread& thread : running) thread.join();
  };
}

/// The spheres of a frame; none where there is an error.
inline std::vector<Sphere> spheres_of(const ParticleFrame& frame, const ParticleStyle& style = {},
                                      const Vec3d& origin = {}) {
  std::vector<Sphere> spheres;
  auto made = ParticleSpheres::make(frame, style);
  if (made && !std::move(made).value().append_to(spheres, origin)) spheres.clear();
  return spheres;
}

/// "KEY: MESSAGE" of the error, or "".
inline std::string error_of(const ParticleFrame& frame, const ParticleStyle& style) {
  const auto made = ParticleSpheres::make(frame, style);
  return made ? "" : made.error().key + ": " + made.error().message;
}

/// The notes, each as a line.
inline std::string notes_of(const ParticleFrame& frame, const ParticleStyle& style = {}) {
  const auto made = ParticleSpheres::make(frame, style);
  if (!made) return "error";
  std::string all;
  for (const std::string& note : made.value().notes()) all += note + "\n";
  return all;
}

/// The colours of the spheres as "#rrggbb", "-" where they keep the material's.
inline std::vector<std::string> colors_of(const ParticleFrame& frame,
                                          const ParticleStyle& style = {}) {
  std::vector<std::string> colors;
  for (const Sphere& sphere : spheres_of(frame, style)) {
    EXPECT_EQ(sphere.material.index(), style.material);
    colors.push_back(sphere.material.has_color() ? hex_text(sphere.material.color()) : "-");
  }
  return colors;
}

inline ParticleColors meaning_of(const ParticleFrame& frame, const ParticleStyle& style = {}) {
  return ParticleSpheres::make(frame, style).value().colors();
}

inline ParticleFrame row_with(const std::string& name, std::vector<double> values) {
  ParticleFrame frame = row_of_particles(values.size());
  frame.numbers.push_back({name, std::move(values)});
  return frame;
}

}  // namespace boule::test
