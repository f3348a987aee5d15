// How fast one thread reads scenes from the page cache: the text of NFF, the rows of .npy, and
// whole scenes of either, beside the rate at which the system hands over the bytes; and the frames
// of particle files. load_peers.py times other readers of the latter.
//
//   bench_load [spheres]
//
// The files are made in the temporary folder, the same for the same number of spheres. A repetition
// goes through all rows; the clock is the process's own CPU time, the system's work for it
// included.
#include <algorithm>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <ctime>
#include <filesystem>
#include <fstream>
#include <functional>
#include <string>
#include <vector>

#include "bench/scenes/random4.h"
#include "bench/scenes/uniform_spheres.h"
#include "render/files/file/input_file.h"
#include "render/files/particle_file/particle_file.h"
#include "render/files/scene_file/nff/nff_reader.h"
#include "render/files/scene_file/npy/npy_reader.h"
#include "render/files/scene_file/scene_file.h"
#include "tests/support/temp_dir.h"

namespace boule::bench {
namespace {

constexpr int repetitions = 5;
constexpr std::size_t spheres_per_fill = 1000;

/// Spheres about the origin with radii of their own, so that numbers differ in sign and length.
std::vector<Sphere> cloud(std::size_t n) {
  std::vector<Sphere> spheres = uniform_spheres(n);
  for (std::size_t i = 0; i < n; ++i) {
    const auto at = random4(static_cast<std::uint32_t>(i), 1, 7);
    Sphere& s = spheres[i];
    s.center = {(s.center.x - 0.5F) * 20, (s.center.y - 0.5F) * 20, (s.center.z - 0.5F) * 20};
    s.radius *= static_cast<float>(1 + 9 * at[0]);
  }
  return spheres;
}

/// With 6 digits as the SPD programs write, or with 9, which tell all floats apart.
std::string nff_text(const std::vector<Sphere>& spheres, int digits) {
  std::string text = "v\nfrom 0 0 50\nat 0 0 0\nup 0 1 0\nangle 45\nhither 1\nresolution 8 8\n";
  char line[128];
  for (std::size_t i = 0; i < spheres.size(); ++i) {
    if (i % spheres_per_fill == 0) text += "f 1 0.9 0.7 0.5 0.5 3.0827 0 1\n";
    const Sphere& s = spheres[i];
    const auto print = [&](float x) {
      std::snprintf(line, sizeof line, " %.*g", digits, static_cast<double>(x));
      text += line;
    };
    text += 's';
    for (const float x : {s.center.x, s.center.y, s.center.z, s.radius}) print(x);
    text += '\n';
  }
  return text;
}

/// A .npy file of this element type, with or without a column of radii.
template <class Number>
std::string npy_bytes(const std::vector<Sphere>& spheres, const char* descr, bool has_radii) {
  std::string dict = std::string("{'descr': '") + descr + "', 'fortran_order': False, 'shape': (" +
                     std::to_string(spheres.size()) + (has_radii ? ", 4), }" : ", 3), }");
  dict.resize(117, ' ');
  std::string bytes = std::string("\x93NUMPY\x01\x00\x76\x00", 10) + dict + "\n";
  for (const Sphere& s : spheres) {
    const Number row[] = {s.center.x, s.center.y, s.center.z, s.radius};
    bytes.append(reinterpret_cast<const char*>(row), (has_radii ? 4 : 3) * sizeof(Number));
  }
  return bytes;
}

/// An XYZ file as simulations write it, or a LAMMPS dump: names, positions and velocities.
std::string particle_text(const std::vector<Sphere>& spheres, bool is_dump) {
  const std::string count = std::to_string(spheres.size());
  std::string text = count + "\ncloud\n";
  if (is_dump) {
    text = "ITEM: TIMESTEP\n0\nITEM: NUMBER OF ATOMS\n" + count +
           "\nITEM: BOX BOUNDS pp pp pp\n-10 10\n-10 10\n-10 10\n"
           "ITEM: ATOMS id type x y z vx vy vz\n";
  }
  char line[256];
  for (std::size_t i = 0; i < spheres.size(); ++i) {
    const double x = spheres[i].center.x, y = spheres[i].center.y, z = spheres[i].center.z;
    if (is_dump) {
      std::snprintf(line, sizeof line, "%zu %zu %g %g %g %g %g %g\n", i + 1, i % 3 + 1, x, y, z,
                    z / 7, x / 7, y / 7);
    } else {
      constexpr const char* elements[] = {"O", "H", "H"};
      std::snprintf(line, sizeof line, "%-2s %14.8f %14.8f %14.8f\n", elements[i % 3], x, y, z);
    }
    text += line;
  }
  return text;
}

/// One thing to time: what it reads, and how. `work` returns the number of spheres it has found.
struct Row {
  std::string name;
  std::uint64_t bytes;
  std::function<std::size_t()> work;
  std::vector<double> times = {};
};

class LoadBench {
 public:
  explicit LoadBench(std::size_t n) : spheres_(cloud(n)) {
    add_nff("6 digits", 6);
    add_nff("9 digits", 9);
    add_npy("float32 N x 4", npy_bytes<float>(spheres_, "<f4", true), true);
    add_npy("float64 N x 4", npy_bytes<double>(spheres_, "<f8", true), true);
    add_npy("float32 N x 3", npy_bytes<float>(spheres_, "<f4", false), false);
    add_particles("cloud.xyz", particle_text(spheres_, false));
    add_particles("cloud.dump", particle_text(spheres_, true));
  }

  /// False if a row found anything but all spheres.
  bool run() {
    for (int i = 0; i < repetitions; ++i) {
      for (Row& row : rows_) {
        const std::clock_t start = std::clock();
        const std::size_t found = row.work();
        row.times.push_back(static_cast<double>(std::clock() - start) / CLOCKS_PER_SEC);
        if (found == spheres_.size()) continue;
        std::fprintf(stderr, "bench_load: %s: found %zu spheres\n", row.name.c_str(), found);
        return false;
      }
    }
    return true;
  }

  void print() {
    for (Row& row : rows_) {
      std::sort(row.times.begin(), row.times.end());
      const double median = row.times[row.times.size() / 2];
      std::printf("%-34s %7.1f MB  %8.1f MB/s  %7.2f Mspheres/s  best %8.1f MB/s\n",
                  row.name.c_str(), static_cast<double>(row.bytes) * 1e-6,
                  static_cast<double>(row.bytes) * 1e-6 / median,
                  static_cast<double>(spheres_.size()) * 1e-6 / median,
                  static_cast<double>(row.bytes) * 1e-6 / row.times.front());
    }
  }

 private:
  /// Reads the file's bytes into the same block of memory, and nothing else.
  void add_read(const std::string& name, const std::string& path, std::uint64_t bytes) {
    rows_.push_back({name + ": read() alone", bytes, [this, path, bytes] {
                       std::vector<char> block(1U << 18);
                       auto file = InputFile::open(path);
                       std::uint64_t done = 0;
                       for (std::size_t got = 1; got > 0; done += got)
                         got = file.value().read(block.data(), block.size()).value();
                       return done == bytes ? spheres_.size() : 0;
                     }});
  }

  void add_load(const std::string& name, const std::string& path, std::uint64_t bytes) {
    rows_.push_back({name + ": load_scene", bytes, [path] {
                       const auto loaded = load_scene(path);
                       return loaded ? loaded.value().scene.spheres.size() : 0;
                     }});
  }

  /// Writes a file and returns its path.
  [[nodiscard]] std::string write(const std::string& name, const std::string& bytes) const {
    const std::filesystem::path path = folder_.path() / name;
    std::ofstream(path, std::ios::binary) << bytes;
    return path.string();
  }

  void add_nff(const std::string& digits, int count) {
    const std::string name = "nff " + digits, text = nff_text(spheres_, count);
    const std::string path = write("cloud" + std::to_string(count) + ".nff", text);
    add_read(name, path, text.size());
    rows_.push_back({name + ": read_text", text.size(), [this, path, bytes = text.size()] {
                       const auto read = read_text(path);
                       return read && read.value().size() == bytes ? spheres_.size() : 0;
                     }});
    rows_.push_back({name + ": read_nff", text.size(), [text, path] {
                       const auto loaded = read_nff(text, path, PolygonPolicy::plane);
                       return loaded ? loaded.value().scene.spheres.size() : 0;
                     }});
    add_load(name, path, text.size());
  }

  void add_npy(const std::string& kind, const std::string& bytes, bool has_radii) {
    const std::string name = "npy " + kind, stem = "cloud" + std::to_string(rows_.size());
    const NpySpheres request{
        write(stem + ".npy", bytes), has_radii ? std::nullopt : std::optional<float>(1), {}};
    const std::string scene =
        write(stem + ".toml", "schema = 1\n[[spheres]]\nfile = \"" + stem + ".npy\"\n" +
                                  (has_radii ? "" : "radius = 1\n"));
    add_read(name, request.path, bytes.size());
    rows_.push_back({name + ": append_spheres", bytes.size(), [request] {
                       std::vector<Sphere> spheres;
                       return append_spheres(request, spheres) ? spheres.size() : 0;
                     }});
    add_load(name, scene, bytes.size());
  }

  void add_particles(const std::string& name, const std::string& text) {
    const std::string path = write(name, text);
    add_read(name, path, text.size());
    rows_.push_back({name + ": open, which finds the frames", text.size(), [this, path] {
                       const auto file = ParticleFile::open(path);
                       return file && file.value().frames() == 1 ? spheres_.size() : 0;
                     }});
    rows_.push_back({name + ": open and read", text.size(), [path] {
                       auto file = ParticleFile::open(path);
                       const auto frame = file.value().read();
                       return frame ? frame.value().size() : 0;
                     }});
  }

  test::TempDir folder_;
  std::vector<Sphere> spheres_;
  std::vector<Row> rows_;
};

}  // namespace
}  // namespace boule::bench

int main(int argc, char** argv) {
  const std::size_t n = argc > 1 ? std::strtoull(argv[1], nullptr, 10) : 2'000'000;
  boule::bench::LoadBench bench(n);
  if (!bench.run()) return 1;
  bench.print();
  return 0;
}
