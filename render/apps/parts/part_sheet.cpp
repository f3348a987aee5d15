#include "render/apps/parts/part_sheet.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstring>
#include <limits>
#include <type_traits>

#include "render/frame/partial_picture.h"

namespace boule {
namespace {

static_assert(std::endian::native == std::endian::little && sizeof(FilmPixel) == 32 &&
              std::is_trivially_copyable_v<FilmPixel> && sizeof(MeasuredPixel) == 24 &&
              std::is_trivially_copyable_v<MeasuredPixel>);

/// Appends count values.
template <class T>
void append_bytes(const T* values, std::size_t count, std::string& text) {
  text.append(reinterpret_cast<const char*>(values), count * sizeof(T));
}

/// Moves count values out of the front of the text.
template <class T>
void take_bytes(T* values, std::size_t count, std::string_view& text) {
  std::memcpy(values, text.data(), count * sizeof(T));
  text.remove_prefix(count * sizeof(T));
}

/// Sums of samples are finite and not negative: settled() saw to that.
bool is_possible(const FilmPixel& pixel) {
  for (const double sum : {pixel.r, pixel.g, pixel.b}) {
    if (!(std::isfinite(sum) && sum >= 0)) return false;
  }
  return pixel.samples >= 0 &&
         pixel.covered <= std::uint64_t{whole_coverage} * static_cast<std::uint64_t>(pixel.samples);
}

bool is_possible(const MeasuredPixel& pixel) {
  for (const float number : {pixel.color.r, pixel.color.g, pixel.color.b, pixel.noise}) {
    if (!(std::isfinite(number) && number >= 0)) return false;
  }
  return pixel.alpha >= 0 && pixel.alpha <= 1 &&
         pixel.samples <= static_cast<std::uint32_t>(std::numeric_limits<int>::max());
}

int samples_of(const FilmPixel& pixel) { return pixel.samples; }
int samples_of(const MeasuredPixel& pixel) { return static_cast<int>(pixel.samples); }

/// The pixels of a block in a film or a measured picture, from their text. False if one cannot be.
template <class Pixels>
bool take_pixels(const PixelRect& block, Pixels& pixels, std::string_view& text) {
  for (int y = block.y0; y < block.y1; ++y) {
    const auto row = pixels.row(block.x0, block.x1, y);
    take_bytes(row.data(), row.size(), text);
    for (const auto& pixel : row) {
      if (!is_possible(pixel)) return false;
    }
  }
  return true;
}

template <class Pixels>
void append_pixels(const PixelRect& block, const Pixels& pixels, std::string& text) {
  for (int y = block.y0; y < block.y1; ++y) {
    const auto row = pixels.row(block.x0, block.x1, y);
    append_bytes(row.data(), row.size(), text);
  }
}

template <class Pixels>
int least_of(const PixelRect& block, const PixelPick& pick, const Pixels& pixels) {
  int least = std::numeric_limits<int>::max();
  for (int y = block.y0; y < block.y1; ++y) {
    int x = block.x0;
    for (const auto& pixel : pixels.row(block.x0, block.x1, y)) {
      if (pick.takes(x++, y)) least = std::min(least, samples_of(pixel));
    }
  }
  return least;
}

template <class Pixels>
int most_of(const PixelRect& rect, const Pixels& pixels) {
  int most = 0;
  for (int y = rect.y0; y < rect.y1; ++y) {
    for (const auto& pixel : pixels.row(rect.x0, rect.x1, y))
      most = std::max(most, samples_of(pixel));
  }
  return most;
}

}  // namespace

std::size_t PartKinds::pixel_bytes() const {
  return (measured ? sizeof(MeasuredPixel) : sizeof(FilmPixel)) + (outline ? 1 : 0) +
         AovChannels::traced(aovs) * sizeof(float);
}

PartKinds kinds_of(const RenderOptions& options) {
  return {options.outline > 0, options.aovs, is_measured(options)};
}

PartSheet::PartSheet(const PixelRect& rect, const PartKinds& kinds)
    : rect_(rect),
      kinds_(kinds),
      film_(kinds.measured ? PixelRect{} : rect),
      measured_(kinds.measured ? rect : PixelRect{}) {
  if (kinds.outline) lines_.emplace(rect);
  if (kinds.aovs.any_traced()) channels_ = AovChannels(kinds.aovs, rect).release();
}

void PartSheet::set_lines(const PixelRect& block, const Outline& outline) {
  for (int y = block.y0; y < block.y1; ++y) {
    for (int x = block.x0; x < block.x1; ++x) lines_->set(x, y, outline.ink(x, y));
  }
}

void PartSheet::set_channels(const PixelRect& block, const std::vector<ImageChannel>& channels,
                             const PixelRect& channels_rect) {
  const auto width = static_cast<std::ptrdiff_t>(block.width());
  for (std::size_t i = 0; i < channels_.size(); ++i) {
    const auto copy = [&](auto& to) {
      const auto& from = std::get<std::decay_t<decltype(to)>>(channels[i].samples);
      for (int y = block.y0; y < block.y1; ++y) {
        const auto* const row = from.data() + channels_rect.index(block.x0, y);
        std::copy(row, row + width, to.data() + rect().index(block.x0, y));
      }
    };
    std::visit(copy, channels_[i].samples);
  }
}

void PartSheet::append(const PixelRect& block, std::string& text) const {
  kinds_.measured ? append_pixels(block, measured_, text) : append_pixels(block, film_, text);
  for (int y = block.y0; lines_ && y < block.y1; ++y) {
    for (int x = block.x0; x < block.x1; ++x) text += static_cast<char>(lines_->ink(x, y));
  }
  const auto width = static_cast<std::size_t>(block.width());
  for (const ImageChannel& channel : channels_) {
    const auto append_rows = [&](const auto& samples) {
      for (int y = block.y0; y < block.y1; ++y)
        append_bytes(samples.data() + rect().index(block.x0, y), width, text);
    };
    std::visit(append_rows, channel.samples);
  }
}

bool PartSheet::take(const PixelRect& block, std::string_view text) {
  const bool good =
      kinds_.measured ? take_pixels(block, measured_, text) : take_pixels(block, film_, text);
  if (!good) return false;
  for (int y = block.y0; lines_ && y < block.y1; ++y) {
    for (int x = block.x0; x < block.x1; ++x) {
      unsigned char ink = 0;
      take_bytes(&ink, 1, text);
      if (ink > Outline::most_ink) return false;
      lines_->set(x, y, ink);
    }
  }
  const auto width = static_cast<std::size_t>(block.width());
  for (ImageChannel& channel : channels_) {
    const auto take_rows = [&](auto& samples) {
      for (int y = block.y0; y < block.y1; ++y)
        take_bytes(samples.data() + rect().index(block.x0, y), width, text);
    };
    std::visit(take_rows, channel.samples);
  }
  return true;
}

Image PartSheet::image(Alpha alpha) const {
  Image image = kinds_.measured ? measured_.image(alpha) : film_.to_image(alpha);
  if (lines_) lines_->draw(image);
  return image;
}

Image PartSheet::partial_image(PixelOrder order, Alpha alpha, const Film& preview) const {
  Image image = kinds_.measured ? partial_picture(preview, measured_, order, alpha)
                                : partial_picture(film_, order, alpha);
  if (lines_) lines_->draw(image);
  return image;
}

std::vector<ImageChannel> PartSheet::release_channels() {
  for (ImageChannel& channel : measured_channels(kinds_.aovs, measured_))
    channels_.push_back(std::move(channel));
  return std::exchange(channels_, {});
}

int PartSheet::least_samples(const PixelRect& block, const PixelPick& pick) const {
  return kinds_.measured ? least_of(block, pick, measured_) : least_of(block, pick, film_);
}

int PartSheet::most_samples() const {
  return kinds_.measured ? most_of(rect_, measured_) : most_of(rect_, film_);
}

bool PartSheet::is_finished(const PixelRect& block, int spp) const {
  return least_samples(block) >= (kinds_.measured ? 1 : spp);
}

std::uint64_t PartSheet::done() const {
  return kinds_.measured ? count_measured(measured_) : film_.total_samples();
}

std::uint64_t PartSheet::all(const std::vector<PixelRect>& blocks, int spp) const {
  std::uint64_t pixels = 0;
  for (const PixelRect& block : blocks) pixels += static_cast<std::uint64_t>(block.area());
  return kinds_.measured ? pixels : pixels * static_cast<std::uint64_t>(spp);
}

std::uint64_t PartSheet::bytes(const PixelRect& rect, const PartKinds& kinds) {
  return rect.area() * kinds.pixel_bytes();
}

}  // namespace boule
