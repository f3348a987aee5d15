#include "render/files/particles/particle_labels.h"

#include <cmath>
#include <cstdint>
#include <functional>
#include <utility>

#include "core/scene/number_text.h"
#include "render/files/particles/particle_choices.h"
#include "render/files/particles/particle_columns.h"
#include "render/files/particles/select/particle_select.h"

namespace boule {
namespace {

/// The text of a particle, by its place.
using TextOf = std::function<std::string(std::size_t particle)>;

std::string text_of_number(double number) {
  if (!std::isfinite(number)) return "missing";
  const bool is_whole = number == std::nearbyint(number) && std::fabs(number) < 1e15;
  return is_whole ? kind_text(number) : number_text(number);
}

TextOf text_of(const TextColumn& column) {
  return [&column](std::size_t i) {
    const std::string& text = column.texts[column.indices[i]];
    return text.empty() ? std::string("missing") : text;
  };
}

Result<TextOf> text_of(const ParticleFrame& frame, const std::string& name) {
  if (const TextColumn* const texts = find_particle_texts(frame, name)) return text_of(*texts);
  auto numbers = find_particle_numbers(frame, name, "label_text");
  if (!numbers) return numbers.error();
  return TextOf(
      [found = std::move(numbers).value()](std::size_t i) { return text_of_number(found.at(i)); });
}

/// Of a rule that names no columns.
TextOf usual_text(const ParticleFrame& frame) {
  for (const char* const name : {"name", "species"}) {
    if (const TextColumn* const texts = find_particle_texts(frame, name)) return text_of(*texts);
  }
  return [](std::size_t i) { return std::to_string(i + 1); };
}

Result<std::vector<TextOf>> texts_of(const ParticleFrame& frame, const LabelRule& rule) {
  std::vector<TextOf> all;
  if (rule.text.empty()) all.push_back(usual_text(frame));
  for (const std::string& name : rule.text) {
    auto one = text_of(frame, name);
    if (!one) return one.error();
    all.push_back(std::move(one).value());
  }
  return all;
}

}  // namespace

Result<std::vector<ParticleLabel>> find_labels(const ParticleFrame& frame, const LabelRule& rule,
                                               const ParticleValues<float>& radii,
                                               const ParallelFor& parallel_for) {
  std::vector<ParticleLabel> labels;
  if (rule.select.empty() || frame.size() == 0) return labels;
  auto selected = select_particles(frame, rule.select, parallel_for);
  if (!selected) return Diagnostic::about("labels", selected.error().message);
  const auto texts = texts_of(frame, rule);
  if (!texts) return texts.error();
  std::size_t count = 0;
  for (std::size_t i = 0; i < frame.size(); ++i) {
    if (selected.value()[i] == 0 || ++count > most_labels) continue;
    ParticleLabel one{frame.positions[i], static_cast<double>(radii[i]), {}};
    for (const TextOf& text : texts.value()) one.text += (one.text.empty() ? "" : " ") + text(i);
    labels.push_back(std::move(one));
  }
  if (count <= most_labels) return labels;
  return Diagnostic::about("labels", std::to_string(count) + " particles would have a label, " +
                                         std::to_string(most_labels) + " at most can");
}

void add_label_columns(const LabelRule& rule, std::vector<std::string>& names) {
  if (rule.select.empty()) return;
  if (rule.text.empty()) names.emplace_back("name");
  for (const std::string& name : rule.text) add_column_names(name, names);
}

}  // namespace boule
