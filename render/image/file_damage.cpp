#include "render/image/file_damage.h"

#include <algorithm>
#include <array>
#include <cstdint>
#include <cstring>
#include <fstream>
#include <string>
#include <string_view>

namespace boule {
namespace {

constexpr const char* too_short = "the file ends within the picture";

/// The next bytes as one number, the highest first; 0 after the end of the file.
std::uint32_t big_endian(std::istream& file, int bytes) {
  std::uint32_t number = 0;
  for (int i = 0; i < bytes; ++i) {
    const int byte = file.get();
    if (byte < 0) return 0;
    number = number << 8 | static_cast<std::uint32_t>(byte);
  }
  return number;
}

/// Whether a JPEG file has its end marker. Goes from marker to marker, over segments and the data
/// between them.
bool is_whole_jpeg(std::istream& file) {
  constexpr int mark = 0xff, end_of_image = 0xd9, first_restart = 0xd0, last_restart = 0xd7;
  if (big_endian(file, 2) != 0xffd8) return true;  // no JPEG file, as its reader will say
  for (int before = 0, byte = file.get(); byte >= 0; before = byte, byte = file.get()) {
    if (before != mark || byte <= 1 || byte == mark) continue;
    if (byte == end_of_image) return true;
    if (byte >= first_restart && byte <= last_restart) continue;
    const std::uint32_t length = big_endian(file, 2);
    if (length > 2) file.seekg(length - 2, std::ios::cur);
  }
  return false;
}

/// The remainder of every byte by PNG's polynomial (PNG specification, annex D).
constexpr auto crc_table = [] {
  constexpr std::uint32_t polynomial = 0xedb88320;
  std::array<std::uint32_t, 256> table{};
  for (std::uint32_t byte = 0; byte < table.size(); ++byte) {
    std::uint32_t rest = byte;
    for (int bit = 0; bit < 8; ++bit) rest = rest >> 1 ^ ((rest & 1) != 0 ? polynomial : 0);
    table[byte] = rest;
  }
  return table;
}();

/// The checksum of the next bytes.
std::uint32_t crc_of(std::istream& file, std::uint32_t bytes) {
  std::uint32_t crc = ~std::uint32_t{0};
  std::array<char, 1 << 14> block;
  while (bytes > 0 && file) {
    file.read(block.data(), std::min<std::streamsize>(bytes, block.size()));
    const auto count = static_cast<std::uint32_t>(file.gcount());
    for (std::uint32_t i = 0; i < count; ++i) {
      crc = crc >> 8 ^ crc_table[(crc ^ static_cast<unsigned char>(block[i])) & 255];
    }
    bytes -= count;
  }
  return ~crc;
}

/// What is wrong with a PNG file. Goes from chunk to chunk, to the end of IEND.
std::string png_damage(std::istream& file) {
  constexpr std::string_view signature = "\x89PNG\r\n\x1a\n";
  constexpr std::uint32_t optional = 0x20000000, end = 0x49454e44;  // in, and of, a chunk's type
  std::array<char, 8> start{};
  file.read(start.data(), start.size());
  if (std::memcmp(start.data(), signature.data(), start.size()) != 0) return {};
  for (;;) {
    const std::uint32_t length = big_endian(file, 4);
    const auto chunk = file.tellg();
    const std::uint32_t type = big_endian(file, 4);
    file.seekg(chunk);
    const std::uint32_t crc = crc_of(file, length + 4);
    const std::uint32_t declared = big_endian(file, 4);
    if (!file) return too_short;
    if (crc != declared && (type & optional) == 0) return "a checksum in the file is wrong";
    if (type == end) return {};
  }
}

/// The next text up to a NUL byte, as an EXR header keeps names.
std::string exr_name(std::istream& file) {
  std::string name;
  std::getline(file, name, '\0');
  return name;
}

/// Whether an EXR file holds all attributes that its headers declare: OpenEXR would allocate any
/// size that is declared.
bool has_whole_exr_headers(std::istream& file) {
  constexpr std::uint32_t magic = 0x762f3101, many_parts = 0x00100000;
  file.seekg(0, std::ios::end);
  const std::streamoff size = file.tellg();
  file.seekg(0);
  if (big_endian(file, 4) != magic) return true;
  const bool in_parts = (big_endian(file, 4) & many_parts) != 0;
  for (bool header_began = false; file;) {
    if (exr_name(file).empty()) {  // the end of a header, or of all if the header is empty
      if (!in_parts || !header_began) return file.good();
      header_began = false;
      continue;
    }
    header_began = true;
    exr_name(file);  // the type
    std::array<unsigned char, 4> low_first{};
    for (unsigned char& byte : low_first) byte = static_cast<unsigned char>(file.get());
    std::streamoff length = 0;
    for (std::size_t i = 4; i-- > 0;) length = length << 8 | low_first[i];
    if (!file || length > size - file.tellg()) return false;
    file.seekg(length, std::ios::cur);
  }
  return false;
}

}  // namespace

std::string file_damage(const std::string& path, const ImageFormat& format) {
  const std::string_view writer = format.writer;
  std::ifstream file(path, std::ios::binary);
  if (writer == "png") return png_damage(file);
  const bool whole = writer == "jpeg"      ? is_whole_jpeg(file)
                     : writer == "openexr" ? has_whole_exr_headers(file)
                                           : true;
  return whole ? "" : too_short;
}

}  // namespace boule
