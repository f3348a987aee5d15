#include "render/parts/part_sheet.h"

#include <bit>
#include <cmath>
#include <cstring>
#include <type_traits>

namespace boule {
namespace {

static_assert(std::endian::native == std::endian::little && sizeof(FilmPixel) == 32 &&
              std::is_trivially_copyable_v<FilmPixel>);

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
  return pixel.samples >= 0 && pixel.covered <= static_cast<std::uint32_t>(pixel.samples);
}

}  // namespace

std::size_t PartKinds::pixel_bytes() const {
  return sizeof(FilmPixel) + (outline ? 1 : 0) + AovChannels::names(aovs).size() * sizeof(float);
}

PartKinds kinds_of(const RenderOptions& options) { return {options.outline > 0, options.aovs}; }

PartSheet::PartSheet(const PixelRect& rect, const PartKinds& kinds) : kinds_(kinds), film_(rect) {
  if (kinds.outline) lines_.emplace(rect);
  if (kinds.aovs.any()) channels_ = AovChannels(kinds.aovs, rect).release();
}

void PartSheet::set_lines(const PixelRect& block, const Outline& outline) {
  for (int y = block.y0; y < block.y1; ++y) {
    for (int x = block.x0; x < block.x1; ++x) lines_->set(x, y, outline.points(x, y));
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
  for (int y = block.y0; y < block.y1; ++y) {
    const auto row = film_.row(block.x0, block.x1, y);
    append_bytes(row.data(), row.size(), text);
  }
  for (int y = block.y0; lines_ && y < block.y1; ++y) {
    for (int x = block.x0; x < block.x1; ++x) text += static_cast<char>(lines_->points(x, y));
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
  for (int y = block.y0; y < block.y1; ++y) {
    const auto row = film_.row(block.x0, block.x1, y);
    take_bytes(row.data(), row.size(), text);
    for (const FilmPixel& pixel : row) {
      if (!is_possible(pixel)) return false;
    }
  }
  constexpr int most_points = outline_grid * outline_grid;
  for (int y = block.y0; lines_ && y < block.y1; ++y) {
    for (int x = block.x0; x < block.x1; ++x) {
      unsigned char points = 0;
      take_bytes(&points, 1, text);
      if (points > most_points) return false;
      lines_->set(x, y, points);
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
  Image image = film_.to_image(alpha);
  if (lines_) lines_->draw(image);
  return image;
}

std::vector<ImageChannel> PartSheet::release_channels() { return std::exchange(channels_, {}); }

std::uint64_t PartSheet::bytes(const PixelRect& rect, const PartKinds& kinds) {
  return rect.area() * kinds.pixel_bytes();
}

}  // namespace boule
