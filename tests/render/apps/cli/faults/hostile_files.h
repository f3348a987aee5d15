#pragma once

#include <functional>
#include <ostream>
#include <string>
#include <vector>

namespace boule::test {

/// A scene that must be refused: the file's name, how it is made, at which "LINE:COLUMN" it is
/// refused, with words of the message, and the key that is named, if one is to blame.
struct HostileScene {
  const char* name;
  const char* file;
  std::function<std::string()> text;
  const char* place;
  const char* words;
  const char* key = "";
};
inline std::ostream& operator<<(std::ostream& out, const HostileScene& scene) {
  return out << scene.name;
}

/// A data file that must be refused: spheres (.npy), a lens (.lens) or a sky (a picture), at line
/// 3, column 8 of a scene that names it; or the rays of boule trace.
struct HostileData {
  const char* name;
  const char* file;
  std::function<std::string()> bytes;
  const char* words;
};
inline std::ostream& operator<<(std::ostream& out, const HostileData& data) {
  return out << data.name;
}

std::vector<HostileScene> hostile_toml();
std::vector<HostileScene> hostile_nff();
std::vector<HostileData> hostile_arrays();
std::vector<HostileData> hostile_lenses_and_pictures();
std::vector<HostileData> hostile_rays();

constexpr std::size_t mebibyte = std::size_t{1} << 20;

/// The bytes as they stand.
inline std::function<std::string()> just(const std::string& bytes) {
  return [bytes] { return bytes; };
}

/// The text again and again, for at least so many bytes.
inline std::string repeated(const std::string& text, std::size_t bytes) {
  std::string all;
  all.reserve(bytes + text.size());
  while (all.size() < bytes) all += text;
  return all;
}

/// What no text begins with.
inline std::string binary() { return repeated(std::string("\x7f\x45\xfe\x01\xff", 5), mebibyte); }

inline std::string utf16(const std::string& text) {
  std::string wide = "\xff\xfe";
  for (const char c : text) (wide += c) += '\0';
  return wide;
}
inline std::string utf16_high_first(const std::string& text) {
  std::string wide = "\xfe\xff";
  for (const char c : text) (wide += '\0') += c;
  return wide;
}

/// What an NFF file begins with: six lines.
constexpr const char* nff_view = "v\nfrom 0 0 5\nat 0 0 0\nup 0 1 0\nangle 45\nresolution 8 8\n";

/// Scenes of a data file: its name stands in line 3, column 8.
inline std::string spheres_of(const std::string& file) {
  return "schema = 1\n[[spheres]]\nfile = \"" + file + "\"\n";
}
inline std::string lens_of(const std::string& file) {
  return "schema = 1\n[camera]\nfile = \"" + file +
         "\"\ntype = \"lens\"\neye = [0, 0, 5]\nlook_at = [0, 0, 0]\n";
}
inline std::string sky_of(const std::string& file) {
  return "schema = 1\n[background]\nfile = \"" + file + "\"\ntype = \"environment\"\n";
}

}  // namespace boule::test
