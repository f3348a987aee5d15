#include "render/files/particles/bonds/bond_capsules.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>

#include "core/math/geometry.h"
#include "render/files/particles/cell_fractions.h"

namespace boule {
namespace {

/// One end of a bond, in the coordinates of the spheres.
struct BondEnd {
  Vec3d center;
  double radius;
  MaterialRef material;
  std::uint32_t group;
};

/// Where a bond's materials meet, as a share of its length.
double middle_of(const BondEnd& a, const BondEnd& b) {
  const Vec3d way = b.center - a.center;
  const double length = std::sqrt(dot(way, way));
  return length > 0 ? std::clamp(0.5 + (a.radius - b.radius) / (2 * length), 0.0, 1.0) : 0.5;
}

class BondDrawer {
 public:
  BondDrawer(const BondedParticles& particles, const BondLook& look, std::vector<Capsule>& capsules)
      : particles_(particles), look_(look), capsules_(capsules) {
    if (particles.cell) fractions_ = CellFractions::of(*particles.cell);
  }

  void draw(const Bond& bond, const ImagePlace& place) {
    ImagePlace other{}, before{};
    for (std::size_t k = 0; k < 3; ++k) {
      other[k] = place[k] + bond.image[k];
      before[k] = place[k] - bond.image[k];
    }
    add_pieces(end(bond.a, place), end(bond.b, other), 0,
               is_shown(bond.b, other) ? 1 : way_out(bond.a, place, bond.b, other));
    if (is_shown(bond.a, before)) return;
    add_pieces(end(bond.a, before), end(bond.b, place), 1 - way_out(bond.b, place, bond.a, before),
               1);
  }

  /// The bond as often as it begins on a face.
  void draw_on_faces(const Bond& bond) {
    particles_.boundary->each_of(bond.a, [&](const ImagePlace& place) {
      ImagePlace other{};
      for (std::size_t k = 0; k < 3; ++k) other[k] = place[k] + bond.image[k];
      if (is_shown(bond.b, other)) add_pieces(end(bond.a, place), end(bond.b, other), 0, 1);
    });
  }

 private:
  [[nodiscard]] bool is_shown(std::uint32_t particle, const ImagePlace& place) const {
    const std::array<int, 3>& counts = particles_.images.counts();
    for (std::size_t k = 0; k < 3; ++k) {
      if (place[k] >= 0 && place[k] < counts[k]) continue;
      if (particles_.boundary == nullptr) return false;
      if (!particles_.boundary->repeats(particle, k, place[k])) return false;
    }
    return true;
  }

  [[nodiscard]] BondEnd end(std::uint32_t particle, const ImagePlace& place) const {
    const MaterialRef own = particles_.materials[particle];
    return {(particles_.positions[particle] - particles_.origin) + particles_.images.shift(place),
            static_cast<double>(particles_.radii[particle]), material_of(own),
            particles_.groups == nullptr
                ? 0
                : particles_.groups->at(particle, place, particles_.images.counts())};
  }

  /// That of a bond's end. Bonds of one colour are ghosts where their particles are.
  [[nodiscard]] MaterialRef material_of(const MaterialRef& own) const {
    if (!look_.material || !look_.material->has_color()) return look_.material.value_or(own);
    return MaterialRef::colored(own.index(), look_.material->color());
  }

  /// The share of the way from an image that is shown to one that is not, up to the face of all
  /// images; half of it where no face lies between them.
  [[nodiscard]] double way_out(std::uint32_t from, const ImagePlace& place, std::uint32_t to,
                               const ImagePlace& other) const {
    double way = 1;
    for (std::size_t k = 0; k < 3 && fractions_; ++k) {
      const std::int64_t count = particles_.images.counts()[k];
      if (other[k] >= 0 && other[k] < count) continue;
      const double face = other[k] < 0 ? 0 : static_cast<double>(count);
      const double begin =
          fractions_->fraction(k, particles_.positions[from]) + static_cast<double>(place[k]);
      const double stop =
          fractions_->fraction(k, particles_.positions[to]) + static_cast<double>(other[k]);
      const double share = (face - begin) / (stop - begin);
      way = std::min(way, share >= 0 && share <= 1 ? share : 0.5);
    }
    return way;
  }

  /// The part of a bond from one share of its length to another.
  void add_pieces(const BondEnd& a, const BondEnd& b, double from, double to) {
    const bool is_one = a.material == b.material && a.group == b.group;
    const double middle = is_one ? 1 : middle_of(a, b);
    if (from < middle) add(a, b, from, std::min(to, middle), a);
    if (to > middle) add(a, b, std::max(from, middle), to, b);
  }

  /// A piece of a bond, which belongs to one of its ends.
  void add(const BondEnd& a, const BondEnd& b, double from, double to, const BondEnd& owner) {
    const auto at = [&](double share) {
      if (share == 0) return vec_cast<float>(a.center);
      if (share == 1) return vec_cast<float>(b.center);
      return vec_cast<float>(a.center + (b.center - a.center) * share);
    };
    constexpr double least = 1e-6;  // less is an error of rounding
    if (!(to - from > least)) return;
    if (OutlineGroups* const list = particles_.group_list; list != nullptr && owner.group != 0) {
      list->capsules.resize(capsules_.size());
      list->capsules.push_back(list->largest + owner.group);
    }
    capsules_.push_back({at(from), at(to), look_.radius, owner.material});
  }

  const BondedParticles& particles_;
  const BondLook& look_;
  std::vector<Capsule>& capsules_;
  std::optional<CellFractions> fractions_;
};

}  // namespace

void append_bonds(const BondedParticles& particles, const std::vector<Bond>& bonds,
                  const BondLook& look, std::vector<Capsule>& capsules) {
  BondDrawer drawer(particles, look, capsules);
  for (std::size_t image = 0; image < particles.images.size(); ++image) {
    const ImagePlace place = particles.images.place(image);
    for (const Bond& bond : bonds) drawer.draw(bond, place);
  }
}

void append_boundary_bonds(const BondedParticles& particles, const std::vector<Bond>& bonds,
                           const BondLook& look, std::vector<Capsule>& capsules) {
  if (particles.boundary == nullptr || particles.boundary->size() == 0) return;
  BondDrawer drawer(particles, look, capsules);
  for (const Bond& bond : bonds) drawer.draw_on_faces(bond);
}

void append_cell_edges(const BondedParticles& particles, const BondLook& look,
                       std::vector<Capsule>& capsules) {
  const ParticleCell& cell = *particles.cell;
  std::array<Vec3d, 3> edges{cell.a, cell.b, cell.c};
  for (std::size_t k = 0; k < 3; ++k) {
    edges[k] = edges[k] * static_cast<double>(particles.images.counts()[k]);
  }
  const Vec3d corner = cell.origin - particles.origin;
  for (std::size_t k = 0; k < 3; ++k) {
    if (edges[k] == Vec3d{}) continue;
    const Vec3d &u = edges[(k + 1) % 3], &v = edges[(k + 2) % 3];
    for (const Vec3d& side : {Vec3d{}, u, u + v, v}) {
      const Vec3d begin = corner + side;
      capsules.push_back({vec_cast<float>(begin), vec_cast<float>(begin + edges[k]), look.radius,
                          look.material.value_or(MaterialRef())});
    }
  }
}

float cell_edge_radius(const ParticleCell& cell) {
  const Vec3d across = cell.a + cell.b + cell.c;
  constexpr double share = 0.0025;
  return static_cast<float>(share * std::sqrt(dot(across, across)));
}

}  // namespace boule
