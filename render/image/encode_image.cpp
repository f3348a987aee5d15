#include "render/image/encode_image.h"

#include <sys/mman.h>
#include <unistd.h>

#include <cerrno>
#include <cstdint>
#include <new>
#include <vector>

#include "render/image/output_file.h"
#include "render/image/tone.h"

namespace boule {
namespace {

/// A file without a name, in memory.
class MemoryFile {
 public:
  MemoryFile() : descriptor_(memfd_create("boule", MFD_CLOEXEC)) {}
  ~MemoryFile() {
    if (descriptor_ >= 0) close(descriptor_);
  }
  MemoryFile(const MemoryFile&) = delete;
  MemoryFile& operator=(const MemoryFile&) = delete;

  [[nodiscard]] int descriptor() const { return descriptor_; }

  /// All bytes of it, or false with errno set.
  bool read_into(std::string& bytes) const {
    const off_t size = lseek(descriptor_, 0, SEEK_END);
    if (size < 0) return false;
    bytes.resize(static_cast<std::size_t>(size));
    for (std::size_t done = 0; done < bytes.size();) {
      const ssize_t count =
          pread(descriptor_, bytes.data() + done, bytes.size() - done, static_cast<off_t>(done));
      if (count < 0 && errno == EINTR) continue;
      if (count == 0) errno = EIO;
      if (count <= 0) return false;
      done += static_cast<std::size_t>(count);
    }
    return true;
  }

 private:
  int descriptor_;
};

Result<std::string> encode_png(const Image& image, const std::string& name,
                               const ImageFileOptions& options) {
  const MemoryFile file;
  if (file.descriptor() < 0) return cannot_write(name, errno);
  if (auto done = write_png(image, {name, file.descriptor()}, options); !done) return done.error();
  std::string bytes;
  if (!file.read_into(bytes)) return cannot_write(name, errno);
  return bytes;
}

Result<std::string> encode_plain(const Image& image, StreamFormat format, const std::string& name,
                                 const ImageFileOptions& options) {
  if (!image.alpha.empty()) {
    return cannot_write(name, std::string(name_of(format)) + " has no room for transparency");
  }
  std::string bytes;
  if (format == StreamFormat::ppm) {
    bytes = "P6\n" + std::to_string(image.width) + " " + std::to_string(image.height) + "\n255\n";
  }
  std::vector<std::uint8_t> codes = tone_map(image, options.exposure_stops);
  if (options.layer) {
    if (options.layer->width != image.width || options.layer->height != image.height)
      return cannot_write(name, "the overlay is not as large as the picture");
    draw_over(*options.layer, 0, 3, codes);
  }
  bytes.append(codes.begin(), codes.end());
  return bytes;
}

}  // namespace

Result<std::string> encode_image(const Image& image, StreamFormat format, const std::string& name,
                                 const ImageFileOptions& options) {
  try {
    return format == StreamFormat::png ? encode_png(image, name, options)
                                       : encode_plain(image, format, name, options);
  } catch (const std::bad_alloc&) {
    return cannot_write(name, ENOMEM);
  }
}

}  // namespace boule
