#pragma once

#include <cstddef>
#include <cstdint>

/// The interface between the library and boule_image_io.so, the module that uses OpenImageIO. Only
/// plain structs and function pointers cross it: no exceptions, nothing of std, no ownership.
namespace boule::image_module {

/// Both change with any change of this file. The mark stands in the module's file, so the loader
/// can refuse a module of another version before any of it has run.
inline constexpr std::uint32_t version = 7;
inline constexpr char version_mark[] = "boule image module, version 7.";

/// The module's one exported symbol: `const Table* boule_image_module()`.
inline constexpr const char* entry_point = "boule_image_module";

enum class SampleType : std::uint32_t { u8, u32, f32 };

/// One channel of a picture.
struct Channel {
  const char* name;
  SampleType type;
};

/// The samples of a channel in some rows: that of pixel i, counted from the first of these rows on,
/// lies at first + i * stride bytes.
struct Samples {
  const unsigned char* first;
  std::size_t stride;
};

enum class AttributeType : std::uint32_t { text, integer, real, matrix };

/// One header entry. `value` points to a C string, an int32, a float or 16 floats.
struct Attribute {
  const char* name;
  AttributeType type;
  const void* value;
};

/// A picture to write. It must outlive its Writer.
struct Picture {
  const char* format;  ///< OpenImageIO's name of the format
  int width, height;
  int x, y, frame_width, frame_height;  ///< the data window in the display window
  const Channel* channels;
  std::size_t channel_count;
  const Attribute* attributes;
  std::size_t attribute_count;
  int threads;
  bool (*stop)(const void* context);  ///< true cancels the writing
  const void* context;
};

/// A picture to read.
struct PictureFile {
  const char* path;
  const char* format;  ///< OpenImageIO's name of the format
  /// Called with the size once the header is known; false cancels the reading.
  bool (*begin)(void* context, int width, int height);
  /// Gives memory for the next `rows` rows of three floats per pixel. Any file can claim any size,
  /// so memory is taken only as rows are found.
  float* (*next)(void* context, int rows);
  void* context;
  bool is_integer;  ///< set by the module: the file holds integers, not floats
};

enum class Outcome : std::uint32_t { done, stopped, system_error, failed };

/// The result of a call, with an errno code for system_error and a text for failed.
struct Report {
  Outcome outcome;
  int code;
  char text[400];
};

/// What the header of an existing file says.
struct FoundPicture {
  int width, height, x, y;        ///< the data window
  int frame_width, frame_height;  ///< the display window
  int channel_count;
  bool has_channels;  ///< exactly the wanted ones, in any order
  bool partial;       ///< its ImageDescription begins with "partial: "
};

/// An existing file, and the channels that it should have.
struct WantedPicture {
  const char* path;
  const char* format;  ///< OpenImageIO's name of the format
  const char* const* channels;
  std::size_t channel_count;
  /// Called with what the header says; false cancels the reading. No memory is taken for rows
  /// before, because any file can claim any size.
  bool (*accepts)(const void* context, const FoundPicture& found);
  const void* context;
};

/// A file that is being written. It belongs to the module until `close`.
struct Writer;

/// The functions of the module.
struct Table {
  std::uint32_t version;
  /// Starts every thread that reading and writing pictures of a format will need with `threads`
  /// threads or fewer. Preconditions: it is called before the other functions are called for that
  /// format, and by one thread at a time.
  void (*start)(const char* format, int threads, Report* report);
  /// Begins a picture in an open, empty, seekable file. Null, with a report, if that fails.
  Writer* (*open)(const Picture* picture, int descriptor, Report* report);
  /// Takes the next rows: their samples, by channel. The file does not depend on how many come at
  /// once. Precondition: there are so many rows left, and no call before has failed.
  void (*put)(Writer* writer, const Samples* samples, int rows, Report* report);
  /// Ends the file and frees the writer. After all rows and no failure the picture is complete;
  /// else the file is useless.
  void (*close)(Writer* writer, Report* report);
  /// Opens a written file and reads its header, its first and its last row, at least.
  void (*check)(const Picture* picture, const char* path, Report* report);
  /// Reads the header of a file and, if that is accepted, all rows.
  void (*inspect)(const WantedPicture* wanted, Report* report);
  /// Reads a picture row by row from the top, three floats per pixel: its first three channels as
  /// they are in the file, integers as 0..1. A single channel counts three times; a third one that
  /// is missing is 0.
  void (*read)(PictureFile* file, Report* report);
};

}  // namespace boule::image_module
