#pragma once

#include <limits>
#include <string>

namespace boule {

/// A file format that write_image() can write.
struct ImageFormat {
  const char* extension;  ///< lower case, without the dot
  const char* writer;     ///< OpenImageIO's name of the format
  /// The largest number of pixels on a side; libjpeg ends the process beyond its limit.
  int longest_side = std::numeric_limits<int>::max();
  /// The largest number of bytes of all texts in the header; far above any remark for formats
  /// without a limit.
  int text_room = 1 << 24;
  bool alpha = false;     ///< stores alpha: premultiplied if it is hdr, otherwise straight
  bool hdr = false;       ///< stores linear floats; otherwise 8 bits with the sRGB curve
  bool channels = false;  ///< stores extra named channels, and the crop window
  bool remarks = false;   ///< its header holds text, such as the remark that a picture is partial
};

/// The format of the extension of a file name, in upper or lower case; null for an unknown
/// extension or without one. Takes any name, and leaves the file unread.
const ImageFormat* find_image_format(const std::string& path);

/// All known extensions for a message: "exr, hdr, png, ...".
std::string known_image_extensions();

/// "unknown image extension, expected one of exr, ...".
std::string unknown_image_extension();

}  // namespace boule
