#pragma once

#include <charconv>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "core/base/error.h"
#include "core/base/text.h"
#include "render/apps/job/render_job.h"

namespace boule {

/// A number in decimal within low .. high, nothing before or after it; else none. Not NaN.
template <class Number>
std::optional<Number> parse_number(const std::string& text, Number low, Number high) {
  Number number{};
  const char* const end = text.data() + text.size();
  const auto [next, error] = std::from_chars(text.data(), end, number);
  const bool good = error == std::errc{} && next == end && number >= low && number <= high;
  return good ? std::optional(number) : std::nullopt;
}

/// The `count` whole numbers from `low` to `high` that `text` consists of.
std::optional<std::vector<int>> split_numbers(const std::string& text, char separator,
                                              std::size_t count, int low, int high);

/// "A-B" with 0 <= A <= B, or "A" alone; "A-B:N" is every Nth of them, from A on, N >= 1.
std::optional<FrameRange> parse_frames(const std::string& text);

/// "1280x720" or "1280X720", each side 1 to 65535.
std::optional<Size> parse_size(const std::string& text);

/// "85mm", "8.5cm", "3.35in" or "241pt", in mm: above 0, 100 m at most.
std::optional<double> parse_length(const std::string& text);

/// "1.5" pixels or "0.5pt": 0 to 100.
std::optional<OutlineWidth> parse_outline(const std::string& text);

/// "X0,Y0,X1,Y1" with 0 <= X0 < X1 and 0 <= Y0 < Y1.
std::optional<PixelRect> parse_crop(const std::string& text);

/// Some of the names in list_aovs(), each once, at least one.
std::optional<AovSelection> parse_aovs(const std::string& text);

/// All names of AOVs: "depth,normal,position,id,albedo,z".
std::string list_aovs();

/// A colour (parse_color()) or "transparent"; and what is probably meant by other text.
std::optional<BackgroundChoice> parse_background(const std::string& text);
std::string hint_background(const std::string& text);

/// A time such as "90", "90s", "1.5m", "500ms", "2h", in seconds: above 0, 1e9 at most.
std::optional<double> parse_duration(const std::string& text);

/// A size such as "500M" or "8G", in powers of 1024, or in bytes: 16M at least.
std::optional<std::uint64_t> parse_bytes(const std::string& text);

/// A whole number of 64 bits.
std::optional<std::uint64_t> parse_seed(const std::string& text);

/// "none", which is 0, or a finite length of 0 or more.
std::optional<float> parse_shadow_epsilon(const std::string& text);

}  // namespace boule
