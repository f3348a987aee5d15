#include "render/apps/job/picture/legend.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstddef>

namespace boule {
namespace {

// In pixels of SVG.
constexpr double text_size = 14, letter_width = 8.6, border = 12;
constexpr double bar_width = 18, bar_height = 220, tick_length = 5;
constexpr double row_height = 22, dot_radius = 7;
constexpr std::size_t rows_in_column = 20;

/// Text in ASCII as XML has it; all else becomes a question mark.
std::string plain_text(std::string text) {
  for (char& c : text) {
    const auto byte = static_cast<unsigned char>(c);
    if (byte < 0x20 || byte >= 0x7f) c = '?';
  }
  return xml_text(text);
}

double width_of(const std::string& text) { return letter_width * static_cast<double>(text.size()); }

/// The parts of a picture, one below the other.
class Legend {
 public:
  void add_scale(const ParticleColors::Scale& scale);
  void add_species(const std::vector<ParticleColors::Species>& all);
  [[nodiscard]] std::string svg() const;

 private:
  void add_text(double x, double y, const std::string& text);
  void add_ticks(double left, double top, double low, double high);

  std::string parts_;
  double width_ = 0, height_ = border;
  int gradients_ = 0;
};

/// A text whose middle is at the height `y`.
void Legend::add_text(double x, double y, const std::string& text) {
  parts_ += fmt::format("<text x=\"{:.1f}\" y=\"{:.1f}\">{}</text>\n", x, y + 0.35 * text_size,
                        plain_text(text));
  width_ = std::max(width_, x + width_of(text) + border);
}

void Legend::add_ticks(double left, double top, double low, double high) {
  for (const auto& [number, text] : legend_ticks(low, high)) {
    const double y = top + bar_height * (high - number) / (high - low);
    parts_ +=
        fmt::format("<path d=\"M{:.1f} {:.2f}h{:.1f}\" stroke=\"#222\"/>\n", left, y, tick_length);
    add_text(left + tick_length + 4, y, text);
  }
}

void Legend::add_scale(const ParticleColors::Scale& scale) {
  constexpr int stops = 64;
  const double low = scale.range[0], high = scale.range[1];
  add_text(border, height_ + text_size / 2, legend_title(scale));
  const double top = height_ + text_size + 10;
  parts_ += fmt::format("<linearGradient id=\"map{}\" x1=\"0\" y1=\"1\" x2=\"0\" y2=\"0\">\n",
                        gradients_);
  for (int i = 0; i <= stops; ++i) {
    const double at = static_cast<double>(i) / stops;
    parts_ +=
        fmt::format("<stop offset=\"{}\" stop-color=\"{}\"/>\n", at, hex_text(scale.map.color(at)));
  }
  parts_ += fmt::format(
      "</linearGradient>\n<rect x=\"{}\" y=\"{:.1f}\" width=\"{}\" height=\"{}\" "
      "fill=\"url(#map{})\" stroke=\"#222\" stroke-width=\"0.75\"/>\n",
      border, top, bar_width, bar_height, gradients_++);
  add_ticks(border + bar_width, top, low, high);
  height_ = top + bar_height + text_size;
}

void Legend::add_species(const std::vector<ParticleColors::Species>& all) {
  const std::size_t columns = (all.size() + rows_in_column - 1) / rows_in_column;
  const std::size_t rows = (all.size() + columns - 1) / columns;
  double left = border, right = border;
  for (std::size_t i = 0; i < all.size(); ++i) {
    if (i > 0 && i % rows == 0) left = right + border;
    const double y = height_ + (static_cast<double>(i % rows) + 0.5) * row_height;
    parts_ += fmt::format(
        "<circle cx=\"{:.1f}\" cy=\"{:.1f}\" r=\"{}\" fill=\"{}\" stroke=\"#222\" "
        "stroke-width=\"0.75\"/>\n",
        left + dot_radius, y, dot_radius, hex_text(all[i].color));
    const double text = left + 2 * dot_radius + 8;
    add_text(text, y, all[i].name);
    right = std::max(right, text + width_of(all[i].name));
  }
  height_ += static_cast<double>(rows) * row_height;
}

std::string Legend::svg() const {
  const double height = height_ + border;
  return fmt::format(
             "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n"
             "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"{0:.0f}\" height=\"{1:.0f}\" "
             "viewBox=\"0 0 {0:.0f} {1:.0f}\" font-family=\"Helvetica, Arial, sans-serif\" "
             "font-size=\"{2}\" fill=\"#222\">\n",
             width_, height, text_size) +
         parts_ + "</svg>\n";
}

}  // namespace

std::vector<double> ticks_within(double low, double high) {
  const double rough = high / 5 - low / 5;  // of the difference, which may be too large
  const double power = std::pow(10.0, std::floor(std::log10(rough)));
  double step = power;
  for (const double factor : {1.0, 2.0, 5.0}) {
    if (factor * power <= rough) step = factor * power;
  }
  std::vector<double> ticks;
  const double first = std::ceil(low / step - 1e-9), last = std::floor(high / step + 1e-9);
  for (double i = first; i <= last && ticks.size() < 16; ++i) {
    ticks.push_back(std::clamp(i == 0 ? 0.0 : i * step, low, high));
  }
  return ticks;
}

std::vector<LegendTick> legend_ticks(double low, double high) {
  const std::vector<double> numbers = ticks_within(low, high);
  const double step = numbers.size() > 1 ? numbers[1] - numbers[0] : high - low;
  const double size = std::max(std::fabs(low), std::fabs(high));
  const int digits = std::clamp(static_cast<int>(std::ceil(-std::log10(step) - 1e-9)), 0, 300);
  const bool is_short = size < 1e6 && digits <= 6;
  // Numbers that differ in their last digits only need these.
  const int precise = std::clamp(static_cast<int>(std::ceil(std::log10(size / step))) + 1, 1, 17);
  std::vector<LegendTick> ticks;
  for (const double number : numbers) {
    ticks.push_back({number, is_short ? fmt::format("{:.{}f}", number, digits)
                                      : fmt::format("{:.{}g}", number, precise)});
  }
  return ticks;
}

std::vector<ParticleColors::Species> legend_rows(const ParticleColors& colors) {
  std::vector<ParticleColors::Species> rows = colors.species;
  if (colors.scale && colors.scale->missing > 0)
    rows.push_back({"", colors.scale->nan_color, colors.scale->missing});
  for (auto& row : rows) {
    if (row.name.empty()) row.name = "missing";
  }
  return rows;
}

std::string legend_title(const ParticleColors::Scale& scale) {
  return scale.unit.empty() ? scale.by : scale.by + " (" + scale.unit + ")";
}

std::string xml_text(const std::string& text) {
  std::string safe;
  for (const char c : text) {
    if (c == '<') {
      safe += "&lt;";
    } else if (c == '>') {
      safe += "&gt;";
    } else if (c == '&') {
      safe += "&amp;";
    } else {
      safe += c;
    }
  }
  return safe;
}

bool has_legend(const std::vector<ParticleColors>& colors) {
  return std::any_of(colors.begin(), colors.end(), [](const ParticleColors& one) {
    return one.scale.has_value() || !one.species.empty();
  });
}

std::vector<ParticleColors> colors_of(const std::vector<ParticleFacts>& particles) {
  std::vector<ParticleColors> colors;
  for (const ParticleFacts& one : particles) colors.push_back(one.colors);
  return colors;
}

std::string legend_svg(const std::vector<ParticleColors>& colors) {
  if (!has_legend(colors)) return {};
  Legend legend;
  for (const ParticleColors& one : colors) {
    if (one.scale) legend.add_scale(*one.scale);
    if (const auto rows = legend_rows(one); !rows.empty()) legend.add_species(rows);
  }
  return legend.svg();
}

}  // namespace boule
