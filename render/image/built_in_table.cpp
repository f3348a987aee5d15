#include "render/image/built_in_table.h"

#include <algorithm>
#include <cstdint>
#include <cstring>
#include <memory>
#include <string_view>
#include <vector>

namespace boule {
namespace {

namespace module = image_module;

module::Writer* opaque(RowWriter* writer) { return reinterpret_cast<module::Writer*>(writer); }
RowWriter* row_writer(module::Writer* writer) { return reinterpret_cast<RowWriter*>(writer); }

void start_nothing(const char*, int, module::Report* report) { *report = {}; }

std::string ppm_header(const module::Picture& picture) {
  return "P6\n" + std::to_string(picture.width) + " " + std::to_string(picture.height) + "\n255\n";
}

module::Writer* open_ppm(const module::Picture* picture, int descriptor, module::Report* report) {
  std::unique_ptr<RowWriter> writer;
  module::guarded(report, [&] {
    writer = std::make_unique<RowWriter>(*picture, descriptor);
    const std::string header = ppm_header(*picture);
    writer->sink().add(reinterpret_cast<const unsigned char*>(header.data()), header.size());
  });
  return opaque(writer.release());
}

void put_ppm(module::Writer* writer, const module::Samples* samples, int rows,
             module::Report* report) {
  module::guarded(report, [&] {
    RowWriter& file = *row_writer(writer);
    file.put(samples, rows, *report, [&file](const unsigned char* row) {
      file.sink().add(row, file.row_bytes());
      return true;
    });
  });
}

void close_ppm(module::Writer* writer, module::Report* report) {
  const std::unique_ptr<RowWriter> file(row_writer(writer));
  module::guarded(report, [&] { file->finish(*report); });
}

/// The header, and as many bytes as there are samples.
void check_ppm(const module::Picture* picture, const char* path, module::Report* report) {
  module::guarded(report, [&] {
    const std::string wanted = ppm_header(*picture);
    const auto samples = static_cast<std::uintmax_t>(picture->width) *
                         static_cast<std::uintmax_t>(picture->height) * picture->channel_count;
    ByteSource file(path);
    std::string found(wanted.size(), '\0');
    std::vector<char> rest(1 << 16);
    bool same = file.read(found.data(), found.size()) == found.size() && found == wanted;
    std::uintmax_t left = samples;
    for (std::size_t got = rest.size(); same && got == rest.size(); left -= got) {
      got = file.read(rest.data(), rest.size());
      same = got <= left;
    }
    if (module::fail_by(file.code(), report)) return;
    if (!same || left != 0) module::fail(report, "the file is not what was written");
  });
}

constexpr module::Table ppm = {module::version, start_nothing, open_ppm, put_ppm,
                               close_ppm,       check_ppm,     nullptr,  nullptr};

}  // namespace

void RowWriter::gather(const module::Samples* samples, std::size_t row) {
  const auto width = static_cast<std::size_t>(picture_.width);
  const std::size_t channels = picture_.channel_count;
  for (std::size_t channel = 0; channel < channels; ++channel) {
    const std::size_t stride = samples[channel].stride;
    const unsigned char* from = samples[channel].first + row * width * stride;
    unsigned char* to = row_.data() + channel;
    for (std::size_t pixel = 0; pixel < width; ++pixel, from += stride, to += channels) *to = *from;
  }
}

bool is_failure(int code, module::Report& report) {
  if (code == 0) return false;
  report.outcome = module::Outcome::system_error;
  report.code = code;
  return true;
}

/// Asks at once, and then in a while, so that writing stops soon after a signal.
bool RowWriter::is_stopped(module::Report& report) {
  since_asked_ += row_bytes();
  if (since_asked_ < often_asked) return false;
  since_asked_ = 0;
  if (!picture_.stop(picture_.context)) return false;
  report.outcome = module::Outcome::stopped;
  return true;
}

const module::Table* built_in_table(const ImageFormat& format) {
  const std::string_view writer = format.writer;
  if (writer == "png") return png_table();
  return writer == "pnm" ? &ppm : nullptr;
}

}  // namespace boule
