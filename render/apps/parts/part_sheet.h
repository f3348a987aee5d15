#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "render/frame/film.h"
#include "render/frame/live_passes.h"
#include "render/frame/measured_picture.h"
#include "render/frame/pixel_order.h"
#include "render/image/write_image.h"
#include "render/renderer/aov_channels.h"
#include "render/renderer/outline.h"
#include "render/renderer/render_options.h"

namespace boule {

/// What a picture has for each pixel, beside its samples.
struct PartKinds {
  bool outline = false;
  AovSelection aovs{};
  bool measured = false;  ///< MeasuredPixels, with noise, in place of samples

  /// Bytes of a pixel in a part's text.
  [[nodiscard]] std::size_t pixel_bytes() const;
};

/// What a picture with these options has.
PartKinds kinds_of(const RenderOptions& options);

/// All that is known of a picture's pixels, or of a part of them: samples, lines and AOVs. Parts
/// travel as text, from process to process and into files, by blocks: of each block first the
/// samples of its pixels (FilmPixel or MeasuredPixel), then the lines, then the channel of each AOV
/// that needs rays of its own; row by row, little-endian.
class PartSheet {
 public:
  /// Nothing is known yet of the frame's pixels in `rect`.
  PartSheet(const PixelRect& rect, const PartKinds& kinds);

  [[nodiscard]] const PixelRect& rect() const { return rect_; }
  [[nodiscard]] const PartKinds& kinds() const { return kinds_; }
  /// The samples: without pixels if kinds().measured holds, or else the other one is.
  [[nodiscard]] Film& film() { return film_; }
  [[nodiscard]] const Film& film() const { return film_; }
  [[nodiscard]] MeasuredPicture& measured() { return measured_; }
  [[nodiscard]] const MeasuredPicture& measured() const { return measured_; }

  /// The fewest samples that a pixel of the block has, of those that are picked; the largest int
  /// where none is. Precondition: the block lies in rect().
  [[nodiscard]] int least_samples(const PixelRect& block, const PixelPick& pick = {}) const;
  /// The most samples that a pixel has.
  [[nodiscard]] int most_samples() const;
  /// Whether all pixels of the block are finished, in a picture of so many samples per pixel.
  [[nodiscard]] bool is_finished(const PixelRect& block, int spp) const;
  /// How many samples all pixels have, or how many pixels are measured.
  [[nodiscard]] std::uint64_t done() const;
  /// The most of them that these blocks can have, in a picture of so many samples per pixel.
  [[nodiscard]] std::uint64_t all(const std::vector<PixelRect>& blocks, int spp) const;

  /// Takes the lines, or the AOVs, of a block from what holds them. Precondition: both have it.
  void set_lines(const PixelRect& block, const Outline& outline);
  void set_channels(const PixelRect& block, const std::vector<ImageChannel>& channels,
                    const PixelRect& channels_rect);

  /// Appends the text of a block. Precondition: it lies in rect().
  void append(const PixelRect& block, std::string& text) const;
  /// Takes a block from its text. Preconditions: it lies in rect(), and the text is
  /// block.area() * kinds().pixel_bytes() long. False if a pixel's samples cannot be: then the
  /// block may be half taken.
  bool take(const PixelRect& block, std::string_view text);

  /// The picture: the samples' means, with the lines drawn.
  [[nodiscard]] Image image(Alpha alpha) const;
  /// The same of an unfinished picture that grew in that order (partial_picture()). `preview` has
  /// what is shown of pixels that are not measured yet; it is of rect().
  [[nodiscard]] Image partial_image(PixelOrder order, Alpha alpha, const Film& preview) const;
  /// The channels of the AOVs; afterwards there are none.
  std::vector<ImageChannel> release_channels();

  /// Bytes that a sheet takes.
  static std::uint64_t bytes(const PixelRect& rect, const PartKinds& kinds);

 private:
  PixelRect rect_;
  PartKinds kinds_;
  Film film_;
  MeasuredPicture measured_;
  std::optional<Outline> lines_;
  std::vector<ImageChannel> channels_;
};

}  // namespace boule
