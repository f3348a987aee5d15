#include "render/files/particles/colors/particle_colors.h"

#include <algorithm>
#include <array>
#include <iterator>
#include <utility>

#include "core/math/color_names.h"
#include "render/files/file/nearest_name.h"
#include "render/files/particles/colors/species_palette.h"
#include "render/files/particles/elements.h"

namespace boule {
namespace {

using Materials = Result<ParticleMaterials>;

bool has_hex_colors(const TextColumn& texts) {
  return std::any_of(texts.texts.begin(), texts.texts.end(),
                     [](const std::string& text) { return text.starts_with('#'); });
}

/// What is done where nothing is said.
ColorRule default_rule(const ParticleFrame& frame) {
  const TextColumn* const texts = find_text_column(frame, "color");
  if (texts != nullptr && has_hex_colors(*texts)) return ColorColumns{{"color"}};
  const std::vector<std::string> rgb{"red", "green", "blue"};
  const bool has_rgb = std::all_of(rgb.begin(), rgb.end(), [&](const std::string& name) {
    return find_number_column(frame, name) != nullptr;
  });
  if (has_rgb) return ColorColumns{rgb};
  if (frame.species) return SpeciesColors{};
  return std::monostate{};
}

/// The colours of rules for one frame.
class Coloring {
 public:
  explicit Coloring(const ColoredFrame& colored)
      : colored_(colored),
        frame_(colored.frame),
        style_(colored.style),
        known_(style_.chosen != nullptr ? style_.chosen->kinds : KnownKinds()) {}

  Materials operator()(std::monostate) const {
    if (auto done = refuse_given("the particles have the colour of their material"); !done)
      return done.error();
    return ParticleMaterials{{{MaterialRef(style_.material)}}};
  }

  Materials operator()(const SrgbColor& color) const {
    if (style_.colors.empty()) return ParticleMaterials{{{colored_.in(color)}}};
    if (!frame_.species) return Diagnostic::about("colors", "the file tells no species");
    const std::vector<SrgbColor> colors(frame_.species->texts.size(), color);
    auto made = of_groups(*frame_.species, colors, 0, true);
    if (made) made.value().own.are_species = true;
    if (made) made.value().own.all = color;
    return made;
  }

  Materials operator()(const SpeciesColors& /*species*/) const {
    if (!frame_.species) return Diagnostic::about("color", "the file tells no species");
    const std::vector<std::string>& texts = frame_.species->texts;
    const auto unknown = std::count_if(texts.begin(), texts.end(), [](const std::string& text) {
      return find_element(text) == nullptr;
    });
    auto made = of_groups(*frame_.species, species_colors(texts, known_),
                          static_cast<std::size_t>(unknown), true);
    if (made) made.value().own.are_species = true;
    return made;
  }

  Materials operator()(const ColorColumns& columns) const {
    if (columns.names.size() == 3) return of_components(columns.names);
    if (columns.names.size() != 1) {
      return Diagnostic::about("color", "expected the name of one column or of three, found " +
                                            std::to_string(columns.names.size()));
    }
    const std::string& name = columns.names.front();
    const TextColumn* const texts = find_particle_texts(frame_, name);
    const bool has_numbers = find_number_column(frame_, name) != nullptr;
    if (const auto names = three_names(name); !names.empty() && !texts && !has_numbers) {
      return of_components(names);
    }
    if (texts == nullptr || has_numbers) {
      auto made = of_numbers({.by = name}, "color");
      if (made) return made;
      if (const auto color = parse_color(name)) return (*this)(*color);
      return with_others(made.error(), name);
    }
    if (has_hex_colors(*texts)) return of_hex_texts(*texts);
    if (frame_.species && texts == &*frame_.species) return (*this)(SpeciesColors{});
    return of_groups(*texts, palette_colors(texts->texts, known_), texts->texts.size(), false);
  }

  Materials operator()(const MappedColors& mapped) const { return of_numbers(mapped, "color.by"); }

 private:
  [[nodiscard]] Materials of_numbers(const MappedColors& mapped, const std::string& key) const {
    auto made = map_numbers(colored_, mapped, key);
    if (!made) return made;
    if (auto done = refuse_given("the colours are a scale of " + quote(mapped.by)); !done)
      return done.error();
    return made;
  }

  [[nodiscard]] Materials of_components(const std::vector<std::string>& names) const {
    if (auto done = refuse_given("the colours are those of columns"); !done) return done.error();
    return take_components(colored_, names);
  }

  /// An error if the style has colours for kinds: there are none.
  [[nodiscard]] Status refuse_given(const std::string& instead) const {
    if (style_.colors.empty()) return {};
    return Diagnostic::about("colors", "expected colours by kind, but " + instead);
  }

  /// A name may have been meant as a colour, and words as the names of columns, unless the error
  /// tells what was meant.
  static Diagnostic with_others(Diagnostic error, const std::string& name) {
    if (error.message.ends_with('?')) return error;
    error.message += name.find(' ') == std::string::npos ? did_you_mean_color(name)
                                                         : ", or three columns: 'red green blue'";
    return error;
  }

  /// A colour for each text.
  [[nodiscard]] ParticleValues<MaterialRef> by_text(const TextColumn& texts,
                                                    const std::vector<SrgbColor>& colors) const {
    ParticleValues<MaterialRef> refs{{}, &texts};
    refs.values.reserve(colors.size());
    for (const SrgbColor& color : colors) refs.values.push_back(colored_.in(color));
    return refs;
  }

  /// The particles of each text are told apart; `from_palette` of the colours are the palette's.
  [[nodiscard]] Materials of_groups(const TextColumn& texts, std::vector<SrgbColor> colors,
                                    std::size_t from_palette, bool are_species) const {
    if (!style_.lacks_kinds) {
      auto done = check_kinds(style_.colors, texts.texts, are_species, "colors");
      if (!done) return done.error();
    }
    use_given(style_.colors, style_.nan_color, texts.texts, are_species, colors);
    ParticleMaterials made{by_text(texts, colors)};
    std::vector<std::size_t> counts(colors.size());
    for (const std::uint32_t index : texts.indices) ++counts[index];
    auto& kinds = made.own.kinds;
    for (std::size_t i = 0; i < colors.size(); ++i)
      kinds.push_back({texts.texts[i], colors[i], counts[i]});
    std::copy_if(kinds.begin(), kinds.end(), std::back_inserter(made.colors.species),
                 [](const auto& kind) { return kind.count > 0; });
    if (from_palette > palette_size) {
      made.notes.push_back("the column " + quote(texts.name) + " has " +
                           std::to_string(from_palette) + " kinds and the palette " +
                           std::to_string(palette_size) + " colours, so they repeat");
    }
    return made;
  }

  [[nodiscard]] Materials of_hex_texts(const TextColumn& texts) const {
    if (auto done = refuse_given("the column " + quote(texts.name) + " has them"); !done)
      return done.error();
    std::vector<SrgbColor> colors;
    std::vector<bool> wrong;
    for (const std::string& text : texts.texts) {
      const auto color = parse_hex_color(text);
      colors.push_back(color.value_or(SrgbColor{}));
      wrong.push_back(!color);
    }
    const auto first = std::find_if(texts.indices.begin(), texts.indices.end(),
                                    [&](std::uint32_t index) { return wrong[index]; });
    if (first == texts.indices.end()) return ParticleMaterials{by_text(texts, colors)};
    const auto particle = static_cast<std::size_t>(first - texts.indices.begin());
    return Diagnostic::about("color", "the colour of " + colored_.name_of(particle) + " is " +
                                          quote(texts.texts[*first]) + ", expected '#rrggbb'");
  }

  ColoredFrame colored_;
  const ParticleFrame& frame_;
  const ParticleStyle& style_;
  const KnownKinds known_;
};

}  // namespace

Result<ParticleMaterials> make_materials(const ParticleFrame& frame, const ParticleStyle& style,
                                         const ParticleNamer& name_of,
                                         const ParallelFor& parallel_for) {
  const ColorRule rule =
      std::holds_alternative<std::monostate>(style.color) ? default_rule(frame) : style.color;
  const bool colored = !std::holds_alternative<std::monostate>(rule);
  if (colored && style.material >= MaterialRef::max_colored) {
    return Diagnostic::about("material", "only the first " +
                                             std::to_string(MaterialRef::max_colored) +
                                             " materials can be given colours");
  }
  return std::visit(Coloring({frame, style, name_of, parallel_for}), rule);
}

}  // namespace boule
