#pragma once

#include <cstddef>
#include <cstdint>

/// The border between the library and boule_image_io.so, the module that holds OpenImageIO: plain
/// structs and function pointers, no exceptions, nothing of std, nothing owned across it.
namespace boule::image_module {

/// Changes with any change of this file; the loader refuses a module of another version, before
/// anything of it has run: the mark stands in the module's file.
inline constexpr std::uint32_t version = 6;
inline constexpr char version_mark[] = "boule image module, version 6.";

/// The module's one exported symbol: `const Table* boule_image_module()`.
inline constexpr const char* entry_point = "boule_image_module";

enum class SampleType : std::uint32_t { u8, u32, f32 };

/// One channel of a picture; pixel i's sample lies at samples + i * stride bytes.
struct Channel {
  const char* name;
  SampleType type;
  const unsigned char* samples;
  std::size_t stride;
};

enum class AttributeType : std::uint32_t { text, integer, real, matrix };

/// One header entry; value points to a C string, an int32, a float or 16 floats.
struct Attribute {
  const char* name;
  AttributeType type;
  const void* value;
};

/// A picture to write: pixels row by row from the top, channels of equal size.
struct Picture {
  const char* format;  ///< OpenImageIO's name of the format
  int width, height;
  int x, y, frame_width, frame_height;  ///< the data window in the display window
  const Channel* channels;
  std::size_t channel_count;
  const Attribute* attributes;
  std::size_t attribute_count;
  int threads;
  bool (*stop)(const void* context);  ///< true gives up
  const void* context;
};

/// A picture to read.
struct PictureFile {
  const char* path;
  const char* format;  ///< OpenImageIO's name of the format
  /// Told the size once the header is known; false gives up.
  bool (*begin)(void* context, int width, int height);
  /// Gives memory for the next `rows` rows of three floats a pixel. A header costs nothing to
  /// write: memory is taken as rows are found in the file.
  float* (*next)(void* context, int rows);
  void* context;
  bool is_integer;  ///< written: its numbers are codes, not floats
};

enum class Outcome : std::uint32_t { done, stopped, system_error, failed };

/// What came of a call: the errno code of a system_error, else a text for failed.
struct Report {
  Outcome outcome;
  int code;
  char text[400];
};

/// What the header of a file on the disk says.
struct FoundPicture {
  int width, height, x, y;        ///< the data window
  int frame_width, frame_height;  ///< the display window
  int channel_count;
  bool has_channels;  ///< exactly those that were asked for, in any order
  bool partial;       ///< its ImageDescription begins with "partial: "
};

/// A file on the disk, and the channels that are asked for.
struct WantedPicture {
  const char* path;
  const char* format;  ///< OpenImageIO's name of the format
  const char* const* channels;
  std::size_t channel_count;
  /// Told what the header says; false gives up. A header costs nothing to write: before this no
  /// memory is taken for rows.
  bool (*accepts)(const void* context, const FoundPicture& found);
  const void* context;
};

/// What the module can do. `start` starts every thread that reading and writing pictures of a
/// format, with so many threads or fewer, will ever start; before anything else of that format is
/// asked for, one call at a time. `write` writes to an open, empty, seekable file; `check` opens a
/// file anew and reads its header, its first and its last row; `inspect` reads all of what is
/// accepted. `read` reads a picture's pixels, row by row from the top, three floats each: its first
/// three channels as they stand in the file (integers as 0..1), gray thrice, 0 for a third channel
/// that is not there.
struct Table {
  std::uint32_t version;
  void (*start)(const char* format, int threads, Report* report);
  void (*write)(const Picture* picture, int descriptor, Report* report);
  void (*check)(const Picture* picture, const char* path, Report* report);
  void (*inspect)(const WantedPicture* wanted, Report* report);
  void (*read)(PictureFile* file, Report* report);
};

}  // namespace boule::image_module
