// Prints a particle file for scripts that compare it with what other readers find.
//
//   boule_print_particles FILE [FORMAT [COLUMN,... [TOPOLOGY]]]
//
// One JSON object for each frame, a line each. Numbers are hexadecimal and thereby exact.
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <limits>
#include <string>
#include <utility>

#include "render/files/particle_file/bridge/bridge_reader.h"
#include "render/files/particle_file/particle_file.h"

namespace boule::test {
namespace {

void print_numbers(const std::vector<double>& numbers) {
  std::printf("[");
  for (std::size_t i = 0; i < numbers.size(); ++i) {
    std::printf("%s\"%a\"", i == 0 ? "" : ", ", numbers[i]);
  }
  std::printf("]");
}

void print_texts(const TextColumn& column) {
  std::printf("[");
  for (std::size_t i = 0; i < column.indices.size(); ++i) {
    std::printf("%s\"%s\"", i == 0 ? "" : ", ", column.texts[column.indices[i]].c_str());
  }
  std::printf("]");
}

void print_frame(const ParticleFrame& frame) {
  std::vector<double> positions, cell;
  for (const Vec3d& p : frame.positions) positions.insert(positions.end(), {p.x, p.y, p.z});
  std::printf("{\"positions\": ");
  print_numbers(positions);
  if (frame.species) {
    std::printf(", \"species\": ");
    print_texts(*frame.species);
  }
  if (frame.cell) {
    const ParticleCell& c = *frame.cell;
    for (const Vec3d& v : {c.a, c.b, c.c, c.origin}) cell.insert(cell.end(), {v.x, v.y, v.z});
    std::printf(", \"periodic\": [%d, %d, %d], \"cell\": ", static_cast<int>(c.periodic[0]),
                static_cast<int>(c.periodic[1]), static_cast<int>(c.periodic[2]));
    print_numbers(cell);
  }
  std::printf(", \"numbers\": {");
  for (std::size_t i = 0; i < frame.numbers.size(); ++i) {
    std::printf("%s\"%s\": ", i == 0 ? "" : ", ", frame.numbers[i].name.c_str());
    print_numbers(frame.numbers[i].values);
  }
  std::printf("}, \"texts\": {");
  for (std::size_t i = 0; i < frame.texts.size(); ++i) {
    std::printf("%s\"%s\": ", i == 0 ? "" : ", ", frame.texts[i].name.c_str());
    print_texts(frame.texts[i]);
  }
  std::printf("}, \"bonds\": [");
  for (std::size_t i = 0; i < frame.bonds.size(); ++i) {
    std::printf("%s[%u, %u]", i == 0 ? "" : ", ", frame.bonds[i].a, frame.bonds[i].b);
  }
  std::printf("]}\n");
}

std::vector<std::string> split(const std::string& text) {
  std::vector<std::string> parts(1);
  for (const char c : text) {
    if (c == ',') {
      parts.emplace_back();
    } else {
      parts.back() += c;
    }
  }
  return parts;
}

int run(int argc, char** argv) {
  ParticleFileOptions options{.most_bonded = std::numeric_limits<std::uint64_t>::max()};
  if (argc > 2) options.format = argv[2];
  if (argc > 3 && *argv[3] != '\0') options.columns = split(argv[3]);
  if (argc > 4) options.topology = argv[4];
  if (const char* const python = std::getenv("BOULE_PYTHON")) set_bridge_python(python);
  auto file = ParticleFile::open(argv[1], options);
  if (!file) {
    std::printf("%s\n", format_diagnostic(file.error()).c_str());
    return 1;
  }
  for (std::size_t i = 0; i < file.value().frames(); ++i) {
    const auto frame = file.value().read(static_cast<long>(i));
    if (!frame) {
      std::printf("%s\n", format_diagnostic(frame.error()).c_str());
      return 1;
    }
    print_frame(frame.value());
  }
  return 0;
}

}  // namespace
}  // namespace boule::test

int main(int argc, char** argv) { return argc < 2 ? 2 : boule::test::run(argc, argv); }
