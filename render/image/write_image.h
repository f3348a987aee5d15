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

/// How an EXR file is packed: none costs the least time, zip the least space.
enum class Compression { none, rle, zip };

/// 16 floats, element (row, column) at [4 * row + column], as OpenEXR's M44f has them.
using MetadataMatrix = std::array<float, 16>;

/// What one entry of a file's header holds.
using MetadataValue = std::variant<std::string, std::int32_t, float, MetadataMatrix>;

/// Names and values for the file's header, as far as the format has room for them (EXR: all). A
/// text ends at its first NUL byte; an empty one means that there is no such entry, no standard one
/// either. Names have 255 bytes at most, none of them control bytes.
using Metadata = std::vector<std::pair<std::string, MetadataValue>>;

/// One more value per pixel, beside R, G and B: "Z", "N.X", "id", ... Row 0 on top, as in Image.
struct ImageChannel {
  std::string name;
  std::variant<std::vector<float>, std::vector<std::uint32_t>> samples;
};

/// Where a cropped picture lies in its frame: the offset of its upper left pixel. A frame width of
/// 0 means that the picture is the whole frame.
struct CropWindow {
  int frame_width = 0, frame_height = 0;
  int x = 0, y = 0;
};

/// How a picture is written.
struct ImageFileOptions {
  Compression compression = Compression::zip;  ///< EXR only
  float exposure_stops = 0;  ///< LDR formats: colours are multiplied by 2^stops before the curve
  CropWindow crop;           ///< formats without channels store the cropped pixels only
  std::vector<ImageChannel> channels;             ///< refused by formats without channels
  std::string date_time = "1970:01:01 00:00:00";  ///< the header's DateTime, EXIF notation
  Metadata metadata;                              ///< an entry replaces a standard one of its name
  int threads = 1;  ///< 1 .. 256, others count as the nearest: for compressing, if they can be had
  std::function<bool()> stop;  ///< asked now and then: true gives up
  /// Told the temporary file's name when it is there, and an empty one when all is in it and the
  /// renaming is next: so a signal's handler can remove it instead of waiting.
  std::function<void(const std::string&)> temporary;
};

/// Writes a picture by its extension: HDR formats as linear RGB float, LDR formats clamped with the
/// sRGB curve, 8 bit. Into a temporary file beside the target (OutputFile), re-opened and checked,
/// then renamed: a failure leaves an old file untouched and nothing behind. Equal arguments make
/// equal files, byte for byte. The Diagnostic says "cannot write 'NAME': REASON", the reason being
/// the system's where there is one: so it does for a picture without pixels or too large for the
/// format, a crop outside its frame, texts longer than the format has room for (JPEG: 60,000 bytes
/// in all, others 16 MiB), channels without a name of their own or of another size, an
/// exception in options.stop or options.temporary. Any numbers are colours: NaN and what is below 0
/// is 0 in LDR formats; EXR keeps them.
///
/// The first picture that is written or read loads OpenImageIO, with half a GiB of addresses, and
/// starts its threads (ImageStart does so before the work): where allocations fail within that, or
/// a thread cannot be had that could a moment before, libraries below it end the process by
/// std::terminate(). A child by fork() of a process in which these threads run writes pictures with
/// one thread; .exr files, where more than one had been asked for, and .tif files only the parent
/// writes and reads: the Diagnostic says so. Such a child ends by _exit() or exec(): what
/// these libraries do at exit() waits for threads that stayed in the parent.
Status write_image(const Image& image, const std::string& path,
                   const ImageFileOptions& options = {});

}  // namespace boule
