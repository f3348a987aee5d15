#include "render/image/module/module_writer.h"

#include <algorithm>
#include <cstdint>
#include <cstring>
#include <string_view>

namespace boule::image_module {
namespace {

size_t size_of(SampleType type) { return type == SampleType::u8 ? 1 : 4; }

/// Rows per call: whole strips of TIFF, which have 32 rows, and whole zip blocks of EXR, which have
/// 16 (OpenImageIO packs whole strips on several threads, and loses what is in a strip that it has
/// begun otherwise); about a MiB, so that writing stops soon after a signal; but at least one block
/// per thread, as long as that is little memory.
int rows_at_once(const Picture& picture, const OIIO::ImageSpec& spec) {
  constexpr size_t block = 32, most_blocks = 8, enough = 1 << 20, most = 1 << 23;
  const size_t block_bytes = static_cast<size_t>(spec.scanline_bytes(true)) * block;
  const size_t usual = std::min(enough / block_bytes, most_blocks);
  const auto threads = static_cast<size_t>(std::max(picture.threads, 1));
  const size_t by_threads = std::min(threads, std::max<size_t>(most / block_bytes, 1));
  return static_cast<int>(block * std::max(usual, by_threads));
}

}  // namespace

std::string reason_of(std::string text) {
  while (!text.empty() && text.back() == '\n') text.pop_back();
  std::replace(text.begin(), text.end(), '\n', ' ');
  return text.empty() ? "OpenImageIO gives no reason" : text;
}

OIIO::TypeDesc type_of(SampleType type) {
  switch (type) {
    case SampleType::u8:
      return OIIO::TypeDesc::UINT8;
    case SampleType::u32:
      return OIIO::TypeDesc::UINT32;
    case SampleType::f32:
      break;
  }
  return OIIO::TypeDesc::FLOAT;
}

void Writer::open(const OIIO::ImageSpec& spec, Report* report) {
  output_ = OIIO::ImageOutput::create(picture_.format);
  if (!output_) return fail(report, reason_of(OIIO::geterror()));
  output_->threads(picture_.threads);
  const std::string name = std::string("picture.") + picture_.format;
  if (!output_->set_ioproxy(&proxy_) || !output_->open(name, spec)) {
    return fail(report, reason_of(output_->geterror()));
  }
  for (size_t i = 0; i < picture_.channel_count; ++i) {
    pixel_size_ += size_of(picture_.channels[i].type);
  }
  at_once_ = rows_at_once(picture_, output_->spec());
}

/// Adds rows as OpenImageIO takes them: the samples of each pixel side by side, no gaps.
void Writer::gather(const Samples* samples, int first, int rows) {
  const auto width = static_cast<size_t>(picture_.width);
  const size_t skipped = static_cast<size_t>(first) * width;
  const size_t count = static_cast<size_t>(rows) * width;
  const size_t begin = static_cast<size_t>(gathered_) * width * pixel_size_;
  packed_.resize(begin + count * pixel_size_);
  unsigned char* to_channel = packed_.data() + begin;
  for (size_t i = 0; i < picture_.channel_count; ++i) {
    const auto [samples_begin, stride] = samples[i];
    const size_t size = size_of(picture_.channels[i].type);
    const unsigned char* from = samples_begin + skipped * stride;
    unsigned char* to = to_channel;
    for (size_t pixel = 0; pixel < count; ++pixel, from += stride, to += pixel_size_) {
      std::memcpy(to, from, size);
    }
    to_channel += size;
  }
  gathered_ += rows;
}

void Writer::put(const Samples* samples, int rows, Report* report) {
  for (int done = 0; done < rows && report->outcome == Outcome::done;) {
    const int fitting = std::min(rows - done, at_once_ - gathered_);
    gather(samples, done, fitting);
    done += fitting;
    const bool is_end = written_ + gathered_ == picture_.height;
    if (gathered_ == at_once_ || is_end) write_gathered(report);
  }
}

void Writer::write_gathered(Report* report) {
  if (picture_.stop(picture_.context)) {
    report->outcome = Outcome::stopped;
    return;
  }
  const bool mixed = !output_->spec().channelformats.empty();
  const OIIO::TypeDesc type = mixed ? OIIO::TypeUnknown : type_of(picture_.channels[0].type);
  const int begin = output_->spec().y + written_;
  if (!output_->write_scanlines(begin, begin + gathered_, 0, type, packed_.data()) &&
      proxy_.code() == 0) {
    return fail(report, reason_of(output_->geterror()));
  }
  fail_by(proxy_.code(), report);
  written_ += gathered_;
  gathered_ = 0;
}

/// Writes a few rows of noise. libpng complains on standard error about a file that is closed
/// without any pixels, and OpenImageIO does not prevent that. libpng keeps rows back while they
/// compress well, but not noise.
void Writer::write_noise() {
  constexpr size_t enough_bytes = 1 << 16;
  const auto row_bytes = static_cast<size_t>(output_->spec().scanline_bytes(true));
  const auto wanted = static_cast<int>(1 + enough_bytes / row_bytes);
  const int end = std::min(picture_.height, written_ + wanted);
  std::vector<unsigned char> noise(static_cast<size_t>(end - written_) * row_bytes);
  std::uint32_t state = 1;
  for (unsigned char& byte : noise) {
    state = state * 1664525U + 1013904223U;  // Numerical Recipes 7.1
    byte = static_cast<unsigned char>(state >> 24);
  }
  const int top = output_->spec().y;
  output_->write_scanlines(top + written_, top + end, 0, output_->spec().format, noise.data());
}

void Writer::close(Report* report) {
  const bool abandoned = written_ < picture_.height;
  if (abandoned && proxy_.code() == 0 && output_->format_name() == std::string_view("png"))
    write_noise();
  const bool closed = output_->close();
  if (!closed) fail(report, reason_of(output_->geterror()));
  fail_by(proxy_.finish(), report);  // the cause of what OpenImageIO may complain about
}

}  // namespace boule::image_module
