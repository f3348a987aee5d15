#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "core/base/chunks.h"
#include "core/scene/number_text.h"
#include "render/files/particles/colors/particle_colors.h"

namespace boule {
namespace {

using Columns = std::array<ParticleNumbers, 3>;
using Components = std::array<double, 3>;

/// Calls body(particle, components) for all particles.
template <class Body>
void for_components(const ColoredFrame& colored, const Columns& columns, const Body& body) {
  in_chunks(
      colored.parallel_for, colored.frame.size(),
      [&](std::size_t, std::size_t begin, std::size_t end) {
        constexpr std::size_t block_size = 1024;
        std::array<std::array<double, block_size>, 3> block;
        for (; begin < end; begin += block_size) {
          const std::size_t stop = std::min(begin + block_size, end);
          for (std::size_t k = 0; k < 3; ++k) columns[k].read(begin, stop, block[k].data());
          for (std::size_t i = begin; i < stop; ++i) {
            body(i, Components{block[0][i - begin], block[1][i - begin], block[2][i - begin]});
          }
        }
      });
}

bool is_part(double v) { return v >= 0 && v <= 1; }
bool is_code(double v) { return v >= 0 && v <= 255 && v == std::floor(v); }

/// The first particles with a component that is not from 0 to 1, not whole and from 0 to 255, or
/// neither of these.
struct Found {
  std::size_t no_part = no_particle, no_code = no_particle, neither = no_particle;
};

Found check(const ColoredFrame& colored, const Columns& columns) {
  std::vector<Found> found(chunks_of(colored.frame.size()));
  for_components(colored, columns, [&](std::size_t i, const Components& components) {
    Found& chunk = found[i / chunk_size];
    for (const double v : components) {
      const bool part = is_part(v), code = is_code(v);
      if (!part) chunk.no_part = std::min(chunk.no_part, i);
      if (!code) chunk.no_code = std::min(chunk.no_code, i);
      if (!part && !code) chunk.neither = std::min(chunk.neither, i);
    }
  });
  Found all;
  for (const Found& chunk : found) {
    all.no_part = std::min(all.no_part, chunk.no_part);
    all.no_code = std::min(all.no_code, chunk.no_code);
    all.neither = std::min(all.neither, chunk.neither);
  }
  return all;
}

Diagnostic wrong_components(const ColoredFrame& colored, const Columns& columns,
                            std::size_t particle) {
  std::string text;
  for (const ParticleNumbers& column : columns) {
    text += (text.empty() ? "" : ", ") + number_text(column.at(particle));
  }
  return Diagnostic::about("color", "the colour of " + colored.name_of(particle) + " is " + text +
                                        ", expected numbers from 0 to 1, or whole numbers to 255");
}

}  // namespace

Result<ParticleMaterials> take_components(const ColoredFrame& colored,
                                          const std::vector<std::string>& names) {
  Columns columns{ParticleNumbers(0), ParticleNumbers(0), ParticleNumbers(0)};
  for (std::size_t k = 0; k < 3; ++k) {
    auto found = find_particle_numbers(colored.frame, names[k], "color");
    if (!found) return found.error();
    columns[k] = std::move(found).value();
  }
  const Found found = check(colored, columns);
  const bool codes = found.no_part != no_particle;
  if (codes && found.no_code != no_particle) {
    const bool parts_and_codes = found.neither == no_particle;
    return wrong_components(colored, columns, parts_and_codes ? found.no_part : found.neither);
  }
  ParticleMaterials made;
  made.materials.values.resize(colored.frame.size());
  const double scale = codes ? 1 : 255;
  for_components(colored, columns, [&](std::size_t i, const Components& components) {
    const auto code = [&](std::size_t k) {
      return static_cast<std::uint8_t>(std::lround(components[k] * scale));
    };
    made.materials.values[i] = colored.in({code(0), code(1), code(2)});
  });
  if (codes) {
    made.notes.push_back("the columns " + quote(names[0]) + ", " + quote(names[1]) + " and " +
                         quote(names[2]) + " are taken as codes from 0 to 255");
  }
  return made;
}

}  // namespace boule
