#include "render/image/write_image.h"

#include "render/image/band_writer.h"
#include "render/image/output_file.h"

namespace boule {
namespace {

ImageForm form_of(const Image& image, const ImageFileOptions& options) {
  ImageForm form{image.width, image.height, image.alpha.empty() ? Alpha::none : Alpha::coverage};
  for (const ImageChannel& channel : options.channels) {
    form.channels.push_back(
        {channel.name, std::holds_alternative<std::vector<std::uint32_t>>(channel.samples)});
  }
  return form;
}

/// The whole picture as one band.
Status write_all(Result<BandWriter> writer, const Image& image, const ImageFileOptions& options) {
  if (!writer) return writer.error();
  if (auto bad = writer.value().put(image, options.channels)) return bad;
  return writer.value().finish();
}

}  // namespace

Status write_image(const Image& image, const std::string& path, const ImageFileOptions& options) {
  return write_all(BandWriter::open(form_of(image, options), path, options), image, options);
}

Status write_png(const Image& image, const OpenFile& file, const ImageFileOptions& options) {
  return write_all(BandWriter::open_png(form_of(image, options), file, options), image, options);
}

}  // namespace boule
