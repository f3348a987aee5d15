#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <memory>
#include <string>
#include <string_view>
#include <utility>
#include <variant>
#include <vector>

#include "core/base/error.h"
#include "core/scene/names.h"
#include "render/image/image.h"
#include "render/image/image_format.h"
#include "render/image/pixel_layer.h"

namespace boule {

/// The compression of an EXR file: none takes the least time, zip the least space.
enum class Compression { none, rle, zip };
template <>
inline constexpr std::array<std::string_view, 3> names<Compression>{"none", "rle", "zip"};

/// 16 floats in the order of OpenEXR's M44f: element (row, column) is at [4 * row + column].
using MetadataMatrix = std::array<float, 16>;

/// The value of one entry of a file's header.
using MetadataValue = std::variant<std::string, std::int32_t, float, MetadataMatrix>;

/// Names and values for a file's header. Each format keeps the entries it has room for; EXR keeps
/// all. A text ends at its first NUL byte. An empty text removes the entry of that name, including
/// a standard one. A name has at most 255 bytes, without control bytes.
using Metadata = std::vector<std::pair<std::string, MetadataValue>>;

/// One more value per pixel, beside R, G and B: "Z", "N.X", "id", ... Row 0 on top, as in Image.
struct ImageChannel {
  std::string name{};
  std::variant<std::vector<float>, std::vector<std::uint32_t>> samples{};
};

/// The frame that a cropped picture is a part of, and the place of the picture's upper left pixel
/// in it. A frame width of 0 means that the picture is the whole frame.
struct CropWindow {
  int frame_width = 0, frame_height = 0;
  int x = 0, y = 0;
};

/// The options for writing a picture.
struct ImageFileOptions {
  Compression compression = Compression::zip;  ///< EXR only
  float exposure_stops = 0;  ///< LDR formats: colours are multiplied by 2^stops before the curve
  CropWindow crop{};         ///< formats without channels store the pixels only, not the window
  std::vector<ImageChannel> channels{};           ///< formats without channels refuse them
  std::string date_time = "1970:01:01 00:00:00";  ///< the header's DateTime, in EXIF notation
  Metadata metadata{};  ///< an entry replaces the standard one of its name
  /// LDR formats: drawn over the picture, whose size it has; null: none. HDR formats refuse it.
  std::shared_ptr<const PixelLayer> layer{};
  int threads = 1;               ///< for compression, 1 .. 256; others are clamped to this range
  std::function<bool()> stop{};  ///< called from time to time; true cancels the writing
  /// Called with the temporary file's name once that file exists, and with an empty name once it is
  /// complete and will be renamed. So a signal handler can remove the file without waiting.
  std::function<void(const std::string&)> temporary{};
};

/// Writes a picture in the format of its extension: HDR formats as linear RGB float, LDR formats
/// clamped, with the sRGB curve, in 8 bits. A picture with alpha gets a channel A: in EXR beside
/// premultiplied colours, in PNG beside straight ones; other formats refuse it. The file is written
/// under a temporary name (OutputFile), opened again, checked, and renamed. So a failure leaves an
/// old file as it was and removes the new one. Equal arguments give equal files, byte for byte.
/// Takes any colours: LDR formats store NaN and negative numbers as 0, EXR stores them as they are.
///
/// The Diagnostic says "cannot write 'NAME': REASON", with the system's reason if there is one. The
/// errors include
/// - a picture without pixels, with alpha for only some pixels, or with a side that is too long for
///   the format,
/// - a crop outside its frame,
/// - texts that are too long for the format (JPEG: 60,000 bytes in all, others 16 MiB),
/// - a channel without a name of its own, or without one sample per pixel,
/// - an exception of options.stop or options.temporary.
///
/// The first picture that is read, or written in a format other than PNG and PPM, loads
/// OpenImageIO, which takes half a GiB of addresses, and starts its threads. If allocations fail
/// during that, or if a thread that was available a moment before cannot be started, libraries
/// below OpenImageIO end the process by std::terminate().
///
/// The threads are missing in a child that is forked afterwards. Such a child writes with one
/// thread. It refuses .tif files, and .exr files if more than one thread had been asked for: only
/// the parent can write and read them. The child must end by _exit() or exec(), because at exit()
/// these libraries wait for the threads.
Status write_image(const Image& image, const std::string& path,
                   const ImageFileOptions& options = {});

/// A file that is open, empty and seekable, and its name for messages.
struct OpenFile {
  const std::string& name;
  int descriptor;
};

/// The same for a PNG into a file of the caller's, which is left unchecked. options.temporary is
/// not called.
Status write_png(const Image& image, const OpenFile& file, const ImageFileOptions& options);

}  // namespace boule
