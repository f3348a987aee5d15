#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <string>
#include <utility>
#include <variant>
#include <vector>

#include "core/base/error.h"
#include "render/image/image.h"
#include "render/image/image_format.h"

namespace boule {

/// How an EXR file is compressed: none takes the least time, zip the least space.
enum class Compression { none, rle, zip };

/// 16 floats in the order of OpenEXR's M44f: element (row, column) is at [4 * row + column].
using MetadataMatrix = std::array<float, 16>;

/// The value of one entry of a file's header.
using MetadataValue = std::variant<std::string, std::int32_t, float, MetadataMatrix>;

/// Names and values for a file's header. Each format keeps what it has room for; EXR keeps all. A
/// text ends at its first NUL byte. An empty text takes the entry of that name away, also a
/// standard one. A name has at most 255 bytes, none of them a control byte.
using Metadata = std::vector<std::pair<std::string, MetadataValue>>;

/// One more value per pixel, beside R, G and B: "Z", "N.X", "id", ... Row 0 on top, as in Image.
struct ImageChannel {
  std::string name{};
  std::variant<std::vector<float>, std::vector<std::uint32_t>> samples{};
};

/// The frame of which a cropped picture is a part, and where in it the picture's upper left pixel
/// lies. A frame width of 0 means that the picture is the whole frame.
struct CropWindow {
  int frame_width = 0, frame_height = 0;
  int x = 0, y = 0;
};

/// How a picture is written.
struct ImageFileOptions {
  Compression compression = Compression::zip;  ///< EXR only
  float exposure_stops = 0;  ///< LDR formats: colours are multiplied by 2^stops before the curve
  CropWindow crop{};         ///< formats without channels store the pixels only, not the window
  std::vector<ImageChannel> channels{};           ///< formats without channels refuse them
  std::string date_time = "1970:01:01 00:00:00";  ///< the header's DateTime, in EXIF notation
  Metadata metadata{};  ///< an entry replaces the standard one of its name
  int threads = 1;      ///< for compression, 1 .. 256; others count as the nearest of these
  std::function<bool()> stop{};  ///< asked now and then; true cancels the writing
  /// Called with the temporary file's name once that file exists, and with an empty name once it is
  /// complete and will be renamed. A signal handler can thus remove the file instead of waiting.
  std::function<void(const std::string&)> temporary{};
};

/// Writes a picture in the format of its extension: HDR formats as linear RGB float, LDR formats
/// clamped, with the sRGB curve, in 8 bits. A picture with alpha gets a channel A: in EXR beside
/// premultiplied colours, in PNG beside straight ones; other formats refuse it. The file is written
/// under a temporary name (OutputFile), opened again, checked, and renamed. So a failure leaves an
/// old file as it was, and nothing else. Equal arguments make equal files, byte for byte. Takes any
/// colours: LDR formats store NaN and negative numbers as 0, EXR stores them as they are.
///
/// The Diagnostic says "cannot write 'NAME': REASON", with the system's reason where there is one.
/// Among the errors are
/// - a picture without pixels, with alpha but not for each pixel, or with more of them on a side
/// than the format can hold,
/// - a crop outside its frame,
/// - texts longer than the format has room for (JPEG: 60,000 bytes in all, others 16 MiB),
/// - a channel without a name of its own, or without one sample per pixel,
/// - an exception of options.stop or options.temporary.
///
/// The first picture that is written, unless it is PNG or PPM, or read loads OpenImageIO, which
/// takes half a GiB of addresses, and starts its threads. If allocations fail meanwhile, or if a
/// thread cannot be started that could be a moment before, libraries below OpenImageIO end the
/// process by std::terminate().
///
/// The threads do not exist in a child that is forked afterwards. Such a child writes with one
/// thread. It refuses .tif files, and .exr files if more than one thread had been asked for: only
/// the parent can write and read them. It has to end by _exit() or exec(), because at exit() these
/// libraries wait for the threads.
Status write_image(const Image& image, const std::string& path,
                   const ImageFileOptions& options = {});

/// A file that is open, empty and seekable, and what messages call it.
struct OpenFile {
  const std::string& name;
  int descriptor;
};

/// The same for a PNG that goes into a file of the caller's, where it is not checked.
/// options.temporary is not called.
Status write_png(const Image& image, const OpenFile& file, const ImageFileOptions& options);

}  // namespace boule
