#include "render/files/particles/particle_radii.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <utility>

#include "core/base/chunks.h"
#include "core/base/text.h"
#include "core/scene/number_text.h"
#include "render/files/file/nearest_name.h"
#include "render/files/particles/elements.h"
#include "render/files/particles/ionic_radii.h"
#include "render/files/particles/particle_columns.h"
#include "render/files/particles/typical_distance.h"

namespace boule {
namespace {

const char* table_text(RadiusTable table) {
  return table == RadiusTable::vdw        ? "van der Waals radii"
         : table == RadiusTable::covalent ? "covalent radii"
                                          : "ionic radii";
}

/// The radius of a species in angstrom; 0 if the table has none.
double table_radius(RadiusTable table, const std::string& species) {
  const Element* const element = find_element(species);
  if (element == nullptr) return 0;
  if (table == RadiusTable::ionic) return ionic_radius(element->symbol);
  return table == RadiusTable::vdw ? element->vdw : element->covalent;
}

/// Decides rules for one frame.
class Decision {
 public:
  Decision(const ParticleFrame& frame, const ParticleStyle& style, ParticleShape shape,
           ParticleChoices& own, const ParallelFor& parallel_for)
      : frame_(frame),
        shape_(shape),
        given_(style.radii),
        chosen_(style.chosen),
        own_(own),
        parallel_for_(parallel_for) {}

  Result<RadiusSource> operator()(double radius) const {
    RadiusSource source;
    source.all = radius;
    source.text = "the same for all";
    return source;
  }

  Result<RadiusSource> operator()(const RadiusColumn& column) const {
    const auto found = find_particle_numbers(frame_, column.name, "radius");
    if (!found) return with_table(found.error(), column.name);
    RadiusSource source = from_column(column.name, 1);
    if (column.name == "diameter") {
      source.notes.emplace_back("the column 'diameter' is taken as radii");
    }
    return source;
  }

  Result<RadiusSource> operator()(RadiusTable table) const {
    if (!frame_.species) {
      return Diagnostic::about(
          "radius", std::string(table_text(table)) + " need elements, the file tells none");
    }
    return from_table(table);
  }

  Result<RadiusSource> operator()(std::monostate) const {
    if (find_number_column(frame_, "radius") != nullptr) return from_column("radius", 1);
    if (find_number_column(frame_, "diameter") != nullptr) return from_column("diameter", 0.5);
    count_elements();
    const ParticleChoices& chosen = chosen_ != nullptr ? *chosen_ : own_;
    if (chosen.are_ionic.value_or(false) && shape_ == ParticleShape::space_filling) {
      RadiusSource source = from_table(RadiusTable::ionic);
      source.notes.push_back("the radii are " + source.text +
                             ", as of salts and oxides (\"vdw\" for van der Waals radii)");
      return source;
    }
    if (chosen.most_are_elements()) {
      RadiusSource source = from_table(RadiusTable::vdw);
      source.notes.push_back("the radii are " + source.text);
      return source;
    }
    RadiusSource source;
    source.all = typical_radius();
    source.text = "half the typical distance to the nearest neighbour";
    source.notes.push_back("the radius is " + source.text + typical_text(source.all));
    return source;
  }

 private:
  /// The error about a column, which may have been meant as the name of a table.
  static Diagnostic with_table(Diagnostic error, const std::string& name) {
    const auto& tables = names<RadiusTable>;
    if (!error.message.ends_with('?'))
      error.message += did_you_mean(ascii_lower(name), {tables.begin(), tables.end()});
    return error;
  }

  static RadiusSource from_column(const std::string& name, double factor) {
    RadiusSource source;
    source.column = name;
    source.factor = factor;
    source.text =
        std::string(factor == 1 ? "the column " : "half of the column ") + printable(name, 40);
    return source;
  }

  RadiusSource from_table(RadiusTable table) const {
    RadiusSource source;
    const double unit = frame_.length_in_angstrom;
    source.text = std::string(table_text(table)) + ", in " +
                  (unit == 1    ? "angstrom"
                   : unit == 10 ? "nm"
                                : number_text(unit) + " angstrom");
    if (frame_.species) {
      for (const std::string& species : frame_.species->texts) {
        const double* const given = find_given(given_, species, true);
        source.by_species.push_back(given != nullptr ? *given
                                                     : table_radius(table, species) / unit);
        if (source.by_species.back() == 0) own_.unlisted.push_back(species);
      }
    }
    // In a series whose other frames have elements.
    if (source.by_species.empty()) source.all = typical_radius();
    const double typical = own_.unlisted.empty() ? 0 : typical_radius();
    std::replace(source.by_species.begin(), source.by_species.end(), 0.0, typical);
    const std::vector<std::string>& unlisted = (chosen_ != nullptr ? *chosen_ : own_).unlisted;
    if (unlisted.empty()) return source;
    const double told = chosen_ != nullptr ? chosen_->typical_radius() : typical;
    source.notes.push_back("the table of " + std::string(table_text(table)) +
                           " lacks the species " + short_list({unlisted.begin(), unlisted.end()}) +
                           ": their radius is half the typical distance to the nearest neighbour" +
                           typical_text(told));
    return source;
  }

  static std::string short_list(std::vector<std::string_view> names) {
    constexpr std::size_t most = 10;
    const std::size_t more = names.size() > most ? names.size() - most : 0;
    if (more == 0) return list_names(names);
    names.resize(most);
    std::string list;
    for (const std::string_view name : names) list += quote(name) + ", ";
    return list + "and " + std::to_string(more) + " more";
  }

  /// Some may be none: the fourth point of water molecules, for instance.
  void count_elements() const {
    own_.particles = frame_.size();
    if (frame_.size() > 0) own_.are_ionic = is_salt(frame_);
    if (!frame_.species) return;
    std::vector<bool> is_element;
    for (const std::string& text : frame_.species->texts) {
      is_element.push_back(find_element(text) != nullptr);
    }
    const auto& indices = frame_.species->indices;
    own_.elements = static_cast<std::size_t>(
        std::count_if(indices.begin(), indices.end(), [&](auto i) { return is_element[i]; }));
  }

  [[nodiscard]] double typical_radius() const {
    if (chosen_ != nullptr && chosen_->distance) return chosen_->typical_radius();
    const double distance = typical_distance(frame_.positions, parallel_for_);
    if (distance > 0) own_.distance = distance;
    return own_.typical_radius();
  }

  /// ", 0.5", and of which frames.
  [[nodiscard]] std::string typical_text(double radius) const {
    const std::string text = ", " + number_text(radius);
    return chosen_ != nullptr && chosen_->distance
               ? text + ", the smallest of " + chosen_->of_frames
               : text;
  }

  const ParticleFrame& frame_;
  const ParticleShape shape_;
  const std::vector<KindRadius>& given_;
  const ParticleChoices* chosen_;
  ParticleChoices& own_;
  const ParallelFor& parallel_for_;
};

bool is_radius(double radius) {
  return radius > 0 && radius <= static_cast<double>(std::numeric_limits<float>::max()) &&
         static_cast<float>(radius) > 0;
}

/// Why a radius cannot be used. `who` is "the radius" or "the radius of particle 3 of 10".
Diagnostic wrong_radius(const std::string& who, double radius, double scale) {
  if (!(radius > 0) || !std::isfinite(radius)) {
    return Diagnostic::about(
        "radius", who + " is " + number_text(radius) + ", expected a finite number above 0");
  }
  return Diagnostic::about(is_radius(radius) ? "scale" : "radius",
                           who + " is " + number_text(radius * scale) + ", which is too " +
                               (radius * scale < 1 ? "small" : "large") + " for a sphere");
}

ParticleRadii one_radius(double radius, bool is_used) {
  return {{{static_cast<float>(radius)}}, is_used ? radius : 0};
}

/// The radii of a chunk; the first that cannot be used, and the least of the others.
struct Chunk {
  std::size_t wrong = no_particle;
  double smallest = std::numeric_limits<double>::infinity();
};

/// Checks the radii and returns the smallest. Writes each to `values` unless that is null.
Result<double> read_radii(const ParticleNumbers& numbers, double factor, double scale,
                          std::size_t count, const ParticleNamer& name_of,
                          const ParallelFor& parallel_for, float* values) {
  std::vector<Chunk> chunks(chunks_of(count));
  in_chunks(parallel_for, count, [&](std::size_t chunk, std::size_t begin, std::size_t end) {
    std::vector<double> block(end - begin);
    numbers.read(begin, end, block.data());
    Chunk found;
    for (std::size_t i = begin; i < end; ++i) {
      const double radius = block[i - begin] * factor * scale;
      if (is_radius(radius)) {
        if (values != nullptr) values[i] = static_cast<float>(radius);
        found.smallest = std::min(found.smallest, radius);
      } else {
        found.wrong = std::min(found.wrong, i);
      }
    }
    chunks[chunk] = found;
  });
  double smallest = std::numeric_limits<double>::infinity();
  for (const Chunk& chunk : chunks) {
    if (chunk.wrong != no_particle) {
      return wrong_radius("the radius of " + name_of(chunk.wrong), numbers.at(chunk.wrong) * factor,
                          scale);
    }
    smallest = std::min(smallest, chunk.smallest);
  }
  return count > 0 ? smallest : 0;
}

/// Puts the radii that a style gives for species into what its rule has chosen.
Status use_given(const ParticleFrame& frame, const ParticleStyle& style, RadiusSource& source) {
  if (!source.column.empty()) {
    return Diagnostic::about("radii", "the radii are those of " + source.text +
                                          ": radii of species need a table or a number for the "
                                          "others, such as 'vdw'");
  }
  if (!frame.species) return Diagnostic::about("radii", "the file tells no species");
  const std::vector<std::string>& species = frame.species->texts;
  if (!style.lacks_kinds) {
    if (auto done = check_kinds(style.radii, species, true, "radii"); !done) return done;
  }
  source.by_species.resize(species.size(), source.all);
  for (std::size_t i = 0; i < species.size(); ++i) {
    const double* const given = find_given(style.radii, species[i], true);
    if (given != nullptr) source.by_species[i] = *given;
  }
  source.text += ", but for species that have their own";
  return {};
}

/// A radius for each species; 0 for what is none, which only species without particles have.
std::vector<float> radii_of_species(const std::vector<double>& by_species, double scale) {
  std::vector<float> radii;
  radii.reserve(by_species.size());
  for (const double radius : by_species) {
    radii.push_back(is_radius(radius * scale) ? static_cast<float>(radius * scale) : 0);
  }
  return radii;
}

}  // namespace

Result<RadiusSource> find_radius_source(const ParticleFrame& frame, const ParticleStyle& style,
                                        ParticleShape shape, ParticleChoices& own,
                                        const ParallelFor& parallel_for) {
  auto source = std::visit(Decision(frame, style, shape, own, parallel_for), style.radius);
  if (!source || style.radii.empty()) return source;
  if (auto done = use_given(frame, style, source.value()); !done) return done.error();
  return source;
}

Result<ParticleRadii> make_radii(const ParticleFrame& frame, const RadiusSource& source,
                                 double scale, const ParticleNamer& name_of,
                                 const ParallelFor& parallel_for) {
  if (source.column.empty() && source.by_species.empty()) {
    if (!is_radius(source.all * scale)) return wrong_radius("the radius", source.all, scale);
    return one_radius(source.all * scale, frame.size() > 0);
  }
  if (!source.column.empty()) {
    const auto numbers = find_particle_numbers(frame, source.column, "radius");
    if (!numbers) return numbers.error();
    std::vector<float> values(frame.size());
    const auto smallest = read_radii(numbers.value(), source.factor, scale, frame.size(), name_of,
                                     parallel_for, values.data());
    if (!smallest) return smallest.error();
    return ParticleRadii{{std::move(values)}, smallest.value()};
  }
  const ParticleNumbers numbers(*frame.species, source.by_species);
  const auto smallest = read_radii(numbers, 1, scale, frame.size(), name_of, parallel_for, nullptr);
  if (!smallest) return smallest.error();
  return ParticleRadii{{radii_of_species(source.by_species, scale), &*frame.species},
                       smallest.value()};
}

}  // namespace boule
