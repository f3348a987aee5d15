#include "render/image/whole_file.h"

#include <array>
#include <cstdint>
#include <cstring>
#include <fstream>
#include <string>
#include <string_view>

namespace boule {
namespace {

/// The next bytes as one number, the highest first; 0 behind the end.
std::uint32_t big_endian(std::istream& file, int bytes) {
  std::uint32_t number = 0;
  for (int i = 0; i < bytes; ++i) {
    const int byte = file.get();
    if (byte < 0) return 0;
    number = number << 8 | static_cast<std::uint32_t>(byte);
  }
  return number;
}

/// From marker to marker, over segments and what lies between, to EOI.
bool is_whole_jpeg(std::istream& file) {
  constexpr int mark = 0xff, end_of_image = 0xd9, first_restart = 0xd0, last_restart = 0xd7;
  if (big_endian(file, 2) != 0xffd8) return true;  // its reader will say that it is none
  for (int before = 0, byte = file.get(); byte >= 0; before = byte, byte = file.get()) {
    if (before != mark || byte <= 1 || byte == mark) continue;
    if (byte == end_of_image) return true;
    if (byte >= first_restart && byte <= last_restart) continue;
    const std::uint32_t length = big_endian(file, 2);
    if (length > 2) file.seekg(length - 2, std::ios::cur);
  }
  return false;
}

/// From chunk to chunk to the end of IEND.
bool is_whole_png(std::istream& file) {
  constexpr std::string_view signature = "\x89PNG\r\n\x1a\n";
  std::array<char, 8> start{};
  file.read(start.data(), start.size());
  if (std::memcmp(start.data(), signature.data(), start.size()) != 0) return true;
  while (file) {
    const std::uint32_t length = big_endian(file, 4), type = big_endian(file, 4);
    file.seekg(length, std::ios::cur);
    big_endian(file, 4);  // its checksum is the reader's
    if (type == 0x49454e44) return file.good();
  }
  return false;
}

/// The text up to a NUL, which a header's names are.
std::string exr_name(std::istream& file) {
  std::string name;
  std::getline(file, name, '\0');
  return name;
}

/// Attribute by attribute through the headers: OpenEXR makes room for any size that one declares.
bool has_whole_exr_headers(std::istream& file) {
  constexpr std::uint32_t magic = 0x762f3101, many_parts = 0x00100000;
  file.seekg(0, std::ios::end);
  const std::streamoff size = file.tellg();
  file.seekg(0);
  if (big_endian(file, 4) != magic) return true;
  const bool in_parts = (big_endian(file, 4) & many_parts) != 0;
  for (bool header_began = false; file;) {
    if (exr_name(file).empty()) {  // the end of a header; of all of them, where nothing was in it
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

bool is_whole_file(const std::string& path, const ImageFormat& format) {
  const std::string_view writer = format.writer;
  std::ifstream file(path, std::ios::binary);
  if (writer == "jpeg") return is_whole_jpeg(file);
  if (writer == "png") return is_whole_png(file);
  if (writer == "openexr") return has_whole_exr_headers(file);
  return true;
}

}  // namespace boule
