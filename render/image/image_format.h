#pragma once

#include <string>

namespace boule {

/// One kind of file that write_image knows.
struct ImageFormat {
  const char* extension;  ///< lower case, without the dot
  const char* writer;     ///< OpenImageIO's name of the format
  int longest_side;       ///< pixels a side at most (libjpeg ends the process beyond its limit)
  int text_room;          ///< bytes of all texts in its header (libjpeg ends the process likewise)
  bool hdr;               ///< linear float; else 8 bit with the sRGB curve
  bool channels;          ///< holds extra named channels, and a crop's place in its frame
  bool remarks;           ///< its header holds text: that a picture is partial, above all
};

/// The format that a file name's extension stands for, upper or lower case; null if it has none or
/// an unknown one. Looks at the name only, which may be any; as all here it throws std::bad_alloc.
const ImageFormat* find_image_format(const std::string& path);

/// True if the file name's extension is that of a format write_image knows (".png", ".exr").
bool is_image_name(const std::string& path);

/// All known extensions for a message: "exr, hdr, png, ...".
std::string known_image_extensions();

/// "unknown image extension, expected one of exr, ...".
std::string unknown_image_extension();

}  // namespace boule
