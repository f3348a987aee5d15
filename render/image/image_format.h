#pragma once

#include <limits>
#include <string>

namespace boule {

/// A file format that write_image() can write.
struct ImageFormat {
  const char* extension;  ///< lower case, without the dot
  const char* writer;     ///< OpenImageIO's name of the format
  /// Most pixels on a side; libjpeg ends the process beyond its limit.
  int longest_side = std::numeric_limits<int>::max();
  /// Most bytes of all texts in the header; far above any remark where the format has no limit.
  int text_room = 1 << 24;
  bool alpha = false;     ///< stores alpha: premultiplied where it is hdr, else straight
  bool hdr = false;       ///< stores linear floats; else 8 bits with the sRGB curve
  bool channels = false;  ///< stores extra named channels, and the crop window
  bool remarks = false;   ///< its header holds text, such as the remark that a picture is partial
};

/// The format that the extension of a file name stands for, in upper or lower case; null if there
/// is no extension or an unknown one. Takes any name, and does not look at the file.
const ImageFormat* find_image_format(const std::string& path);

/// All known extensions for a message: "exr, hdr, png, ...".
std::string known_image_extensions();

/// "unknown image extension, expected one of exr, ...".
std::string unknown_image_extension();

}  // namespace boule
