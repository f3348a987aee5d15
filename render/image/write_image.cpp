#include "render/image/write_image.h"

#include <cerrno>
#include <new>

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

/// The whole picture as one band, by the writer that open(form) makes for a file of this name.
template <class Open>
Status write_all(const Image& image, const std::string& name, const ImageFileOptions& options,
                 const Open& open) {
  try {
    Result<BandWriter> writer = open(form_of(image, options));
    if (!writer) return writer.error();
    if (auto done = writer.value().put(image, options.channels); !done) return done;
    return writer.value().finish();
  } catch (const std::bad_alloc&) {
    return cannot_write(name, ENOMEM);
  }
}

}  // namespace

Status write_image(const Image& image, const std::string& path, const ImageFileOptions& options) {
  return write_all(image, path, options,
                   [&](const ImageForm& form) { return BandWriter::open(form, path, options); });
}

Status write_png(const Image& image, const OpenFile& file, const ImageFileOptions& options) {
  return write_all(image, file.name, options, [&](const ImageForm& form) {
    return BandWriter::open_png(form, file, options);
  });
}

}  // namespace boule
