#include "render/files/particles/bonds/particle_bonds.h"

#include <algorithm>
#include <array>
#include <limits>
#include <string_view>
#include <tuple>
#include <utility>

#include "core/scene/number_text.h"
#include "core/scene/primitive.h"
#include "core/scene/scene.h"
#include "render/files/particles/elements.h"
#include "render/memory/available_memory.h"

namespace boule {
namespace {

/// Files that bring bonds start with them up to this number of particles.
constexpr std::size_t most_of_bonded_start = 1000;

constexpr double ball_of_vdw = 0.23, ball_of_others = 0.5;
// In angstrom, and as shares of a diameter.
constexpr double stick_of_balls = 0.14, stick_alone = 0.22;
constexpr double share_of_balls = 0.1, share_alone = 0.25;

/// Ions of salts: what elements of groups 1 and 2 are, but hydrogen, beryllium and magnesium.
bool makes_bonds(const Element& element) {
  constexpr std::array<std::string_view, 10> ions{"Li", "Na", "K",  "Rb", "Cs",
                                                  "Fr", "Ca", "Sr", "Ba", "Ra"};
  return element.covalent > 0 && std::find(ions.begin(), ions.end(), element.symbol) == ions.end();
}

bool most_are_elements(const ParticleFrame& frame) {
  if (!frame.species) return false;
  std::vector<bool> is_element;
  for (const std::string& text : frame.species->texts) {
    is_element.push_back(find_element(text) != nullptr);
  }
  const auto& indices = frame.species->indices;
  const auto count =
      std::count_if(indices.begin(), indices.end(), [&](auto i) { return is_element[i]; });
  return static_cast<std::size_t>(count) > indices.size() / 2;
}

/// Which particles the file's bonds join.
std::vector<std::uint8_t> joined_by(const std::vector<ParticleBond>& bonds, std::size_t count) {
  std::vector<std::uint8_t> joined(count);
  for (const auto& [a, b] : bonds) joined[a] = joined[b] = 1;
  return joined;
}

bool is_small_with_bonds(const ParticleFrame& frame) {
  if (frame.size() > most_of_bonded_start || frame.bonds.empty()) return false;
  const auto joined = joined_by(frame.bonds, frame.size());
  return static_cast<std::size_t>(std::count(joined.begin(), joined.end(), 1)) > frame.size() / 2;
}

bool has_rule(const BondChoice& bonds, BondRule rule) {
  const auto* const named = std::get_if<BondRule>(&bonds);
  return named != nullptr && *named == rule;
}

/// Finds the bonds of one frame.
class BondMaker {
 public:
  BondMaker(ParticleFrame& frame, const BondPlan& plan, const ParticleValues<float>& radii,
            std::uint64_t most, const ParallelFor& parallel_for)
      : frame_(frame), plan_(plan), radii_(radii), most_(most), parallel_for_(parallel_for) {}

  Result<std::vector<Bond>> operator()(std::monostate) const { return std::vector<Bond>(); }

  Result<std::vector<Bond>> operator()(double distance) const {
    BondSearch search;
    search.reach.values = {distance / 2};
    return found(search);
  }

  Result<std::vector<Bond>> operator()(BondRule rule) const {
    switch (rule) {
      case BondRule::none:
        return std::vector<Bond>();
      case BondRule::contacts:
        return contacts();
      case BondRule::file:
        if (!plan_.has_listed && frame_.size() > 0) {
          return Diagnostic::about("bonds", "the file lists no bonds");
        }
        return listed();
      case BondRule::distance:
        if (!has_elements() && frame_.size() > 0) {
          return Diagnostic::about(
              "bonds",
              "bonds by distance need elements, the file tells none: expected a number, below "
              "which distances are bonds, or \"contacts\"");
        }
        return by_distance();
      case BondRule::automatic:
        break;
    }
    return automatic();
  }

 private:
  Result<std::vector<Bond>> automatic() const {
    if (plan_.has_listed && (frame_.lists_all_bonds || !has_elements())) {
      frame_.notes.emplace_back("the bonds are those of the file");
      return listed();
    }
    if (!has_elements() && plan_.unwraps && frame_.size() > 0) {
      return Diagnostic::about("unwrap",
                               "the file tells neither bonds nor elements: \"bonds\" may be a "
                               "number, below which distances are bonds");
    }
    if (!has_elements()) {
      frame_.notes.emplace_back("without elements, and without bonds in the file, none are drawn");
      return std::vector<Bond>();
    }
    frame_.notes.emplace_back(plan_.has_listed ? "the bonds are those of the file, and by distance"
                                               : "the bonds are by distance");
    auto bonds = by_distance();
    if (!bonds || frame_.bonds.empty()) return bonds;
    const std::vector<Bond> of_file = listed();
    std::vector<Bond>& all = bonds.value();
    all.insert(all.end(), of_file.begin(), of_file.end());
    std::sort(all.begin(), all.end(), [](const Bond& p, const Bond& q) {
      return std::tie(p.a, p.b, p.image) < std::tie(q.a, q.b, q.image);
    });
    // A bond by distance may be one of the file that another particle's bonds have not hidden.
    all.erase(std::unique(all.begin(), all.end()), all.end());
    return bonds;
  }

  [[nodiscard]] bool has_elements() const {
    if (!frame_.species) return false;
    const auto& texts = frame_.species->texts;
    return std::any_of(texts.begin(), texts.end(),
                       [](const std::string& text) { return find_element(text) != nullptr; });
  }

  [[nodiscard]] std::vector<Bond> listed() const {
    return nearest_images(frame_.bonds, frame_.positions, frame_.cell);
  }

  Result<std::vector<Bond>> by_distance() const {
    if (!frame_.species) return std::vector<Bond>();
    constexpr double tolerance = 0.4, nearest = 0.4;  // angstrom
    const double unit = frame_.length_in_angstrom;
    BondSearch search{.tolerance = tolerance / unit, .nearest = nearest / unit};
    std::vector<std::uint8_t> is_hydrogen;
    for (const std::string& species : frame_.species->texts) {
      const Element* const element = find_element(species);
      const bool bonds = element != nullptr && makes_bonds(*element);
      search.reach.values.push_back(bonds ? element->covalent / unit : 0);
      is_hydrogen.push_back(element == all_elements().data() ? 1 : 0);
    }
    search.reach.kinds = &*frame_.species;
    if (std::count(is_hydrogen.begin(), is_hydrogen.end(), 1) > 0) {
      search.single.reserve(frame_.size());
      for (const std::uint32_t i : frame_.species->indices) search.single.push_back(is_hydrogen[i]);
    }
    if (has_rule(plan_.bonds, BondRule::automatic) && !frame_.bonds.empty()) {
      search.known = joined_by(frame_.bonds, frame_.size());
    }
    return found(search);
  }

  [[nodiscard]] Result<std::vector<Bond>> contacts() const {
    BondSearch search;
    search.reach.kinds = radii_.kinds;
    search.reach.values.assign(radii_.values.begin(), radii_.values.end());
    return found(search);
  }

  [[nodiscard]] Result<std::vector<Bond>> found(const BondSearch& search) const {
    return find_bonds(frame_.positions, frame_.cell, search, most_, parallel_for_);
  }

  ParticleFrame& frame_;
  const BondPlan& plan_;
  const ParticleValues<float>& radii_;
  std::uint64_t most_;
  const ParallelFor& parallel_for_;
};

}  // namespace

std::uint64_t most_bonded_of(const ParticleStyle& style) {
  if (style.unwrap || style.outline_by == OutlineChoice(OutlineRule::molecule))
    return std::numeric_limits<std::uint64_t>::max();
  const bool is_open = std::holds_alternative<std::monostate>(style.bonds);
  if (is_open && !style.shape) return most_of_bonded_start;
  const bool may_list =
      is_open ? *style.shape != ParticleShape::space_filling
              : has_rule(style.bonds, BondRule::automatic) || has_rule(style.bonds, BondRule::file);
  return may_list ? std::numeric_limits<std::uint64_t>::max() : 0;
}

Result<BondPlan> plan_bonds(const ParticleFrame& frame, const ParticleStyle& style,
                            ParticleChoices& own) {
  if (frame.size() > 0) own.starts_bonded = is_small_with_bonds(frame);
  BondPlan plan{.bonds = style.bonds,
                .has_listed = !frame.bonds.empty(),
                .unwraps = style.unwrap,
                .wraps = style.wrap};
  const bool is_open = std::holds_alternative<std::monostate>(style.bonds);
  const bool has_own_radii =
      !std::holds_alternative<std::monostate>(style.radius) || !style.radii.empty();
  if (style.shape) {
    plan.shape = *style.shape;
  } else if (!is_open && !has_rule(style.bonds, BondRule::none)) {
    plan.shape = ParticleShape::balls_and_sticks;
  } else if (is_open && !has_own_radii && style.scale == 1) {
    const ParticleChoices& chosen = style.chosen != nullptr ? *style.chosen : own;
    if (chosen.starts_bonded.value_or(false)) plan.shape = ParticleShape::balls_and_sticks;
  }
  if (is_open) {
    plan.bonds = plan.shape == ParticleShape::space_filling ? BondRule::none : BondRule::automatic;
  }
  if (plan.shape != ParticleShape::sticks || !has_own_radii) return plan;
  return Diagnostic::about(style.radii.empty() ? "radius" : "radii",
                           "sticks have one radius, \"bond_radius\", for particles and bonds");
}

double choose_bond_radius(const ParticleFrame& frame, const ParticleStyle& style,
                          const BondPlan& plan, double smallest_radius, ParticleChoices& own) {
  if (style.bond_radius) return *style.bond_radius;
  const bool alone = plan.shape == ParticleShape::sticks;
  if (most_are_elements(frame)) {
    return (alone ? stick_alone : stick_of_balls) / frame.length_in_angstrom;
  }
  if (frame.size() > 0) own.smallest_radius = smallest_radius;
  if (style.chosen != nullptr && style.chosen->smallest_radius) {
    smallest_radius = *style.chosen->smallest_radius;
  }
  return 2 * smallest_radius * (alone ? share_alone : share_of_balls);
}

RadiusSource shaped_radii(RadiusSource source, const ParticleFrame& frame,
                          const ParticleStyle& style, const BondPlan& plan, double bond_radius) {
  std::erase_if(source.notes, [](const std::string& note) {
    return note.starts_with("the radii are ") || note.starts_with("the radius is ");
  });
  if (plan.shape == ParticleShape::sticks) {
    return {.all = bond_radius, .text = "that of the bonds", .notes = std::move(source.notes)};
  }
  if (!std::holds_alternative<std::monostate>(style.radius)) return source;
  const bool by_table = source.column.empty() && !source.by_species.empty();
  const double share = by_table ? ball_of_vdw : ball_of_others;
  source.all *= share;
  source.factor *= share;
  for (std::size_t i = 0; i < source.by_species.size(); ++i) {
    const bool is_given = find_given(style.radii, frame.species->texts[i], true) != nullptr;
    if (!is_given) source.by_species[i] *= share;
  }
  source.text = number_text(share) + " of " + source.text;
  source.notes.push_back("balls and sticks: the radii are " + source.text);
  return source;
}

Result<std::vector<Bond>> make_bonds(ParticleFrame& frame, const BondPlan& plan,
                                     const ParticleValues<float>& radii, std::uint64_t images,
                                     const ParallelFor& parallel_for) {
  constexpr std::uint64_t of_bond = 64, capsules_of_bond = 2;  // bytes, before it is drawn
  const std::uint64_t room =
      available_memory() / (of_bond + capsules_of_bond * images * sizeof(Capsule));
  const std::uint64_t most = std::min(room, max_primitives / capsules_of_bond / images);
  const BondMaker make(frame, plan, radii, most, parallel_for);
  return std::visit(make, plan.bonds);
}

}  // namespace boule
