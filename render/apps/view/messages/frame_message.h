#pragma once

#include <array>
#include <cstdint>
#include <string>

namespace boule::view {

enum class PictureCode : std::uint8_t { jpeg = 1, png = 2 };

/// The pictures that a client sees.
inline constexpr int difference_pane = 2, picture_count = 3;

/// What stands before a picture in a binary message: docs/view_protocol.md.
struct FrameHeader {
  PictureCode code = PictureCode::jpeg;
  int pane = 0;
  bool finished = false, moving = false;
  int scale = 1;
  std::uint32_t number = 0;  ///< the last one of the client that it shows
  std::uint32_t frame = 0;
  int width = 0, height = 0;
  std::uint32_t passes = 0;
  float spp = 0, share = 0;
};

inline constexpr std::size_t frame_header_size = 32;

/// The header's bytes.
std::array<char, frame_header_size> encode(const FrameHeader& header);

/// A header and its picture; none if they are no frame. For clients.
struct Frame {
  FrameHeader header;
  std::string picture;
};
bool decode(const std::string& message, Frame& frame);

}  // namespace boule::view
