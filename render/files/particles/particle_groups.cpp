#include "render/files/particles/particle_groups.h"

#include <algorithm>
#include <bit>
#include <numeric>
#include <string>
#include <unordered_map>

#include "render/files/file/nearest_name.h"
#include "render/files/particles/elements.h"
#include "render/files/particles/particle_columns.h"
#include "render/memory/available_memory.h"

namespace boule {
namespace {

/// Numbers for what is met, from 1, in the order in which it is met.
class GroupNumbers {
 public:
  std::uint32_t of(std::uint64_t key) {
    return numbers_.try_emplace(key, static_cast<std::uint32_t>(numbers_.size() + 1)).first->second;
  }
  [[nodiscard]] std::uint32_t count() const { return static_cast<std::uint32_t>(numbers_.size()); }

 private:
  std::unordered_map<std::uint64_t, std::uint32_t> numbers_;
};

/// Splits the groups by a column: what differs there is no longer of one group. `value(i)` is a
/// particle's value as 64 bits.
template <class Value>
void split_groups(ParticleGroups& groups, const Value& value) {
  GroupNumbers values, pairs;
  for (std::size_t i = 0; i < groups.of_particles.size(); ++i) {
    const std::uint64_t number = values.of(value(i));
    groups.of_particles[i] = pairs.of(number << 32 | groups.of_particles[i]);
  }
  groups.count = pairs.count();
}

/// The same by a column of texts or numbers. False if the frame has none of that name.
bool split_by_column(const ParticleFrame& frame, const std::string& name, ParticleGroups& groups) {
  if (const TextColumn* const texts = find_particle_texts(frame, name)) {
    split_groups(groups, [&](std::size_t i) { return std::uint64_t{texts->indices[i]}; });
    return true;
  }
  const NumberColumn* const numbers = find_number_column(frame, name);
  if (numbers == nullptr) return false;
  // 0 + x makes one of both zeros; missing numbers may differ in their bits, which say nothing.
  split_groups(groups,
               [&](std::size_t i) { return std::bit_cast<std::uint64_t>(0 + numbers->values[i]); });
  return true;
}

Diagnostic no_such_groups(const ParticleFrame& frame, const std::string& name) {
  const std::vector<std::string_view> rules(names<OutlineRule>.begin(), names<OutlineRule>.end());
  const std::string meant = did_you_mean(name, rules);
  if (meant.empty()) return no_such_column(frame, name, "outline_by");
  return Diagnostic::about("outline_by", "there is no column " + quote(name) + meant);
}

bool tells_elements(const ParticleFrame& frame) {
  if (!frame.species) return false;
  const auto& texts = frame.species->texts;
  return std::any_of(texts.begin(), texts.end(),
                     [](const std::string& text) { return find_element(text) != nullptr; });
}

/// What is bonded, directly or through others. Bonds that lead to other images make one of all
/// images.
Status join_bonded(const ParticleFrame& frame, const std::vector<Bond>& bonds,
                   ParticleGroups& groups) {
  if (bonds.empty() && frame.size() > 1 && !tells_elements(frame)) {
    return Diagnostic::about("outline_by",
                             "the file tells no molecules: neither a column 'mol', nor bonds, nor "
                             "elements");
  }
  std::vector<std::uint32_t> parents(frame.size());
  std::iota(parents.begin(), parents.end(), 0U);
  const auto find = [&](std::uint32_t particle) {
    while (parents[particle] != particle) particle = parents[particle] = parents[parents[particle]];
    return particle;
  };
  for (const Bond& bond : bonds) {
    const auto [low, high] = std::minmax(find(bond.a), find(bond.b));
    parents[high] = low;
    if (bond.image != std::array<std::int32_t, 3>{}) groups.of_images = false;
  }
  split_groups(groups,
               [&](std::size_t i) { return std::uint64_t{find(static_cast<std::uint32_t>(i))}; });
  return {};
}

Status split_by(const ParticleFrame& frame, OutlineRule rule, const std::vector<Bond>& bonds,
                ParticleGroups& groups) {
  switch (rule) {
    case OutlineRule::object:
    case OutlineRule::depth:
      break;
    case OutlineRule::kind:
      if (frame.species) split_by_column(frame, frame.species->name, groups);
      break;
    case OutlineRule::molecule:
      if (!split_by_column(frame, "mol", groups)) return join_bonded(frame, bonds, groups);
      break;
    case OutlineRule::chain:
      if (!split_by_column(frame, "chain", groups))
        return no_such_column(frame, "chain", "outline_by");
      break;
    case OutlineRule::residue:
      if (find_number_column(frame, "resid") == nullptr &&
          find_particle_texts(frame, "resid") == nullptr) {
        return no_such_column(frame, "resid", "outline_by");
      }
      for (const std::string& name : outline_columns(rule)) split_by_column(frame, name, groups);
      break;
  }
  return {};
}

}  // namespace

std::uint32_t ParticleGroups::at(std::size_t particle, const ImagePlace& place,
                                 const std::array<int, 3>& counts) const {
  if (empty()) return 0;
  const std::uint32_t group = of_particles[of_particles.size() > 1 ? particle : 0];
  if (!of_images) return group;
  std::uint32_t image = 0;
  for (std::size_t k = 3; k-- > 0;) {
    const auto last = static_cast<std::int64_t>(counts[k]) - 1;
    image = image * static_cast<std::uint32_t>(counts[k]) +
            static_cast<std::uint32_t>(std::clamp<std::int64_t>(place[k], 0, last));
  }
  return group + count * image;
}

bool needs_bonds(const OutlineChoice& outline, const ParticleFrame& frame) {
  const auto* const rule = std::get_if<OutlineRule>(&outline);
  return rule != nullptr && *rule == OutlineRule::molecule &&
         find_particle_texts(frame, "mol") == nullptr &&
         find_number_column(frame, "mol") == nullptr;
}

Result<ParticleGroups> make_groups(const ParticleFrame& frame, const OutlineChoice& outline,
                                   const std::vector<Bond>& bonds) {
  const auto* const rule = std::get_if<OutlineRule>(&outline);
  const auto* const column = std::get_if<std::string>(&outline);
  const bool is_object = column == nullptr && (rule == nullptr || *rule == OutlineRule::object);
  if (is_object || frame.size() == 0) return ParticleGroups{};
  if (rule != nullptr && *rule == OutlineRule::depth) return ParticleGroups{{1}, 1, false};
  constexpr std::uint64_t of_particle = 48;  // with what finds the numbers
  if (auto done = check_memory(of_particle * frame.size(), "groups of outlines need", "outline_by");
      !done) {
    return done.error();
  }
  ParticleGroups groups{std::vector<std::uint32_t>(frame.size(), 1), 1, true};
  if (rule != nullptr) {
    groups.of_images = *rule != OutlineRule::kind;
    if (auto done = split_by(frame, *rule, bonds, groups); !done) return done.error();
  } else if (!split_by_column(frame, *column, groups)) {
    return no_such_groups(frame, *column);
  }
  return groups;
}

}  // namespace boule
