#include "render/apps/view/messages/frame_message.h"

#include <algorithm>
#include <bit>
#include <cstring>

namespace boule::view {
namespace {

constexpr std::array<char, 4> magic{'B', 'V', 'F', '1'};

/// Writes numbers one after the other, the lowest byte first.
class Bytes {
 public:
  void add(std::uint32_t value, std::size_t count) {
    for (std::size_t i = 0; i < count; ++i)
      all[at_++] = static_cast<char>(static_cast<unsigned char>(value >> (8 * i)));
  }
  std::array<char, frame_header_size> all{};

 private:
  std::size_t at_ = 0;
};

std::uint32_t read(const char* from, std::size_t count) {
  std::uint32_t value = 0;
  for (std::size_t i = 0; i < count; ++i)
    value |= std::uint32_t{static_cast<unsigned char>(from[i])} << (8 * i);
  return value;
}

}  // namespace

std::array<char, frame_header_size> encode(const FrameHeader& header) {
  Bytes bytes;
  for (const char c : magic) bytes.add(static_cast<unsigned char>(c), 1);
  bytes.add(static_cast<std::uint32_t>(header.code), 1);
  bytes.add(static_cast<std::uint32_t>(header.pane), 1);
  bytes.add((header.finished ? 1U : 0U) + (header.moving ? 2U : 0U), 1);
  bytes.add(static_cast<std::uint32_t>(header.scale), 1);
  bytes.add(header.number, 4);
  bytes.add(header.frame, 4);
  bytes.add(static_cast<std::uint32_t>(header.width), 2);
  bytes.add(static_cast<std::uint32_t>(header.height), 2);
  bytes.add(header.passes, 4);
  bytes.add(std::bit_cast<std::uint32_t>(header.spp), 4);
  bytes.add(std::bit_cast<std::uint32_t>(header.share), 4);
  return bytes.all;
}

bool decode(const std::string& message, Frame& frame) {
  if (message.size() < frame_header_size) return false;
  const char* const from = message.data();
  if (!std::equal(magic.begin(), magic.end(), from)) return false;
  FrameHeader& header = frame.header;
  header.code = static_cast<PictureCode>(read(from + 4, 1));
  header.pane = static_cast<int>(read(from + 5, 1));
  header.finished = (read(from + 6, 1) & 1) != 0;
  header.moving = (read(from + 6, 1) & 2) != 0;
  header.scale = static_cast<int>(read(from + 7, 1));
  header.number = read(from + 8, 4);
  header.frame = read(from + 12, 4);
  header.width = static_cast<int>(read(from + 16, 2));
  header.height = static_cast<int>(read(from + 18, 2));
  header.passes = read(from + 20, 4);
  header.spp = std::bit_cast<float>(read(from + 24, 4));
  header.share = std::bit_cast<float>(read(from + 28, 4));
  frame.picture = message.substr(frame_header_size);
  return true;
}

}  // namespace boule::view
