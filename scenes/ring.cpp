/// Writes a planet and its rings as a .npy file for [[spheres]]: float32 rows of center and radius.
///
///   boule_ring COUNT FILE.npy|-     COUNT 2 .. 4,000,000,000 spheres; -: to standard output
///
/// The planet has the radius 1 and lies at the origin, the rings around it in the plane y = 0, of
/// the radii that Saturn's have: the thin C ring, the bright B ring, the gap that Cassini saw and
/// the A ring. However many particles there are, the rings are equally opaque: the more, the
/// smaller. Only + - * / and roots: the bytes are the same on every machine.
#include <bit>
#include <charconv>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <string>
#include <string_view>

#include "core/math/random.h"

namespace {

using boule::mix64;

constexpr double pi = 3.141592653589793;
constexpr std::uint64_t most = 4'000'000'000;

/// A ring between two radii. Opacity: how much area its particles cover, divided by its own.
struct Ring {
  double inner, outer, opacity;

  [[nodiscard]] constexpr double covered() const {
    return opacity * pi * (outer * outer - inner * inner);
  }
};
constexpr Ring rings[] = {
    {1.24, 1.53, 0.12}, {1.53, 1.95, 1.6}, {2.03, 2.21, 0.6}, {2.22, 2.27, 0.6}};

/// Particles' radii in units of their scale: between these, so many the larger by r^-3.
constexpr double least_radius = 0.5, greatest_radius = 3;
constexpr double mean_square = 0.9215;  // of such radii: 2 ln(3 / 0.5) / (1 / 0.25 - 1 / 9)

/// Numbers in [0, 1) that depend on a particle and on how many were asked for before.
class Numbers {
 public:
  explicit Numbers(std::uint64_t particle) : state_(mix64(particle)) {}

  double next() {
    state_ = mix64(state_ + boule::golden_step);
    return static_cast<double>(state_ >> 11) * 0x1p-53;
  }

 private:
  std::uint64_t state_;
};

/// Writes numbers as float32, little-endian, many at a time.
class Output {
 public:
  explicit Output(std::FILE* file) : file_(file) {}

  void text(std::string_view bytes) { bytes_ += bytes; }
  void number(double x) {
    const auto bits = std::bit_cast<std::uint32_t>(static_cast<float>(x));
    for (int shift = 0; shift < 32; shift += 8) bytes_ += static_cast<char>(bits >> shift & 0xff);
    if (bytes_.size() >= piece) flush();
  }
  /// Writes what is left. False if anything could not be written.
  bool finish() {
    flush();
    return std::fflush(file_) == 0 && good_;
  }

 private:
  static constexpr std::size_t piece = std::size_t{1} << 20;

  void flush() {
    good_ = good_ && std::fwrite(bytes_.data(), 1, bytes_.size(), file_) == bytes_.size();
    bytes_.clear();
  }

  std::FILE* file_;
  std::string bytes_;
  bool good_ = true;
};

/// The 128 bytes that NumPy puts before float32 data of `rows` x 4 (format version 1.0).
std::string npy_header(std::uint64_t rows) {
  std::string dict =
      "{'descr': '<f4', 'fortran_order': False, 'shape': (" + std::to_string(rows) + ", 4), }";
  dict.resize(128 - 10 - 1, ' ');
  return std::string("\x93NUMPY\x01\x00", 8) + static_cast<char>(dict.size() + 1) + '\0' + dict +
         '\n';
}

double covered_by_all() {
  double sum = 0;
  for (const Ring& ring : rings) sum += ring.covered();
  return sum;
}

/// The ring that a number in [0, 1) picks: by how much its particles cover.
const Ring& pick_ring(double number) {
  double rest = number * covered_by_all();
  for (const Ring& ring : rings) {
    if (rest < ring.covered()) return ring;
    rest -= ring.covered();
  }
  return rings[0];
}

/// Writes one particle of the rings. `scale`: of the radii.
void write_particle(std::uint64_t particle, double scale, Output& output) {
  Numbers numbers(particle);
  const Ring& ring = pick_ring(numbers.next());
  const double inner = ring.inner * ring.inner, outer = ring.outer * ring.outer;
  const double distance = std::sqrt(inner + numbers.next() * (outer - inner));
  double x = 0, z = 0, square = 0;
  while (square > 1 || square < 1e-4) {  // a direction, by a point of the disc
    x = 2 * numbers.next() - 1;
    z = 2 * numbers.next() - 1;
    square = x * x + z * z;
  }
  const double stretch = distance / std::sqrt(square);
  double height = -2;  // about normal, by four numbers
  for (int k = 0; k < 4; ++k) height += numbers.next();
  constexpr double high = 1 / (least_radius * least_radius);
  constexpr double low = 1 / (greatest_radius * greatest_radius);
  const double radius = scale / std::sqrt(low + numbers.next() * (high - low));
  output.number(x * stretch);
  output.number(height * 8 * scale);
  output.number(z * stretch);
  output.number(radius);
}

bool write_rings(std::uint64_t count, std::FILE* file) {
  Output output(file);
  output.text(npy_header(count));
  for (const double number : {0.0, 0.0, 0.0, 1.0}) output.number(number);
  const double particles = static_cast<double>(count - 1);
  const double scale = std::sqrt(covered_by_all() / (particles * pi * mean_square));
  for (std::uint64_t i = 1; i < count; ++i) write_particle(i, scale, output);
  return output.finish();
}

/// COUNT of the command line, or 0.
std::uint64_t parse_count(std::string_view text) {
  std::uint64_t count = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), count);
  const bool is_number = error == std::errc{} && end == text.data() + text.size();
  return is_number && count >= 2 && count <= most ? count : 0;
}

}  // namespace

int main(int argc, char** argv) {
  const std::uint64_t count = argc == 3 ? parse_count(argv[1]) : 0;
  if (count == 0) {
    std::fputs("usage: boule_ring COUNT FILE.npy|-    (COUNT 2 to 4000000000)\n", stderr);
    return 2;
  }
  const bool to_output = std::string_view(argv[2]) == "-";
  std::FILE* const file = to_output ? stdout : std::fopen(argv[2], "wb");
  bool good = file != nullptr && write_rings(count, file);
  if (file != nullptr && !to_output) good = std::fclose(file) == 0 && good;
  if (good) return 0;
  std::fprintf(stderr, "error: cannot write '%s'\n", argv[2]);
  return 1;
}
