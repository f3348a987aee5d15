#include "render/renderer/scene_hash.h"

#include <bit>
#include <functional>
#include <optional>
#include <string>
#include <type_traits>
#include <variant>

#include "core/base/float_environment.h"
#include "core/math/random.h"
#include "core/scene/instances.h"
#include "core/scene/sphere_digest.h"

namespace boule {
namespace {

/// Adds values one after the other, each in 64 bits: of a struct its fields in the order of their
/// list, of a variant the index and the value, of a list the length and the elements.
class Hasher {
 public:
  void add(std::uint64_t word) { state_ = mix64(state_ + word) + golden_step; }
  void add(std::uint32_t number) { add(std::uint64_t{number}); }
  void add(int number) { add(static_cast<std::uint64_t>(number)); }
  void add(bool flag) { add(std::uint64_t{flag}); }
  void add(MaterialRef material) { add(material.bits()); }
  void add(float x) { add(std::bit_cast<std::uint32_t>(x)); }
  template <class Enum>
  requires std::is_enum_v<Enum>
  void add(Enum value) { add(static_cast<std::uint64_t>(value)); }

  void add(const Vec3f& v) {
    for (const float component : {v.x, v.y, v.z}) add(component);
  }
  void add(const Color& c) {
    for (const float component : {c.r, c.g, c.b}) add(component);
  }
  void add(const Both<const int>& both) {
    add(both.first);
    add(both.second);
  }
  /// Names are not in the hash.
  void add(const std::string&) {}

  template <HasFields T>
  void add(const T& value) {
    each_field(value, [this](const auto&, const auto& member) { this->add(member); });
  }
  template <class T>
  void add(const std::optional<T>& some) {
    add(some.has_value());
    if (some) add(*some);
  }
  template <class... Kinds>
  void add(const std::variant<Kinds...>& one_of) {
    add(std::uint64_t{one_of.index()});
    std::visit([this](const auto& value) { this->add(value); }, one_of);
  }
  /// A list without capsules adds nothing, so that scenes without any keep the hash that files
  /// already hold.
  void add(const std::vector<Capsule>& capsules) {
    if (capsules.empty()) return;
    add(capsule_mark);
    add(std::uint64_t{capsules.size()});
    for (const Capsule& one : capsules) add(one);
  }
  template <class T>
  void add(const std::vector<T>& list) {
    add(std::uint64_t{list.size()});
    for (const T& one : list) add(one);
  }

  [[nodiscard]] std::uint64_t value() const { return mix64(state_); }

  /// Comes before capsules: "capsule" as a number, which no count is.
  static constexpr std::uint64_t capsule_mark = 0x656c7573706163;
  /// Comes before clips: "clip" as a number, beyond what counts of capsules, groups or instances
  /// reach.
  static constexpr std::uint64_t clip_mark = 0x70696c63000000;

 private:
  std::uint64_t state_ = 0;
};

/// Adds the sections of a scene in their order: all values that affect a picture.
class SceneHasher {
 public:
  SceneHasher(const Scene& scene, const ParallelFor& parallel_for)
      : scene_(scene), parallel_for_(parallel_for), shares_(groups_to_share(scene).has_value()) {
    each_field(scene, [this](const auto&, const auto& section) { this->add(section); });
  }

  [[nodiscard]] std::uint64_t value() const { return hash_.value(); }

 private:
  template <class Section>
  void add(const Section& section) {
    hash_.add(section);
  }
  /// Image and render settings are left out of the hash.
  void add(const ImageSettings&) {}
  void add(const RenderSettings&) {}
  /// The fit is left out if the scene has a camera or leaves the fit at its defaults.
  void add(const CameraFit& fit) {
    if (!scene_.camera && !(fit == CameraFit{})) hash_.add(fit);
  }
  /// A scene without a distortion adds nothing, so that it keeps the hash that files already hold.
  void add(const std::optional<DistortionMap>& distortion) {
    if (distortion) hash_.add(*distortion);
  }
  /// The same for a scene without a backdrop.
  void add(const std::optional<Color>& backdrop) {
    if (backdrop) hash_.add(*backdrop);
  }
  /// The scene's own spheres and those that its instances show, as one list. Packed spheres are the
  /// only ones where they exist. Shared groups hold too many spheres for a pass over them.
  void add(const std::vector<Sphere>& spheres) {
    if (scene_.packed) return hash_.add(scene_.packed->digest);
    hash_.add(digest_of(spheres, !shares_));
  }
  void add(const std::vector<Plane>& planes) { add_with_shown(planes); }
  /// The same for a scene that is not cut.
  void add(const std::vector<Clip>& clips) {
    if (clips.empty()) return;
    hash_.add(Hasher::clip_mark);
    hash_.add(clips);
  }
  void add(const std::vector<Capsule>& capsules) {
    if (count_.capsules == 0) return;
    hash_.add(Hasher::capsule_mark);
    add_with_shown(capsules);
  }
  /// Shared groups are added as they are: their spheres, and all others in order.
  void add(const std::vector<Group>& groups) {
    if (!shares_) return;
    hash_.add(std::uint64_t{groups.size()});
    for (const Group& group : groups) {
      hash_.add(digest_of(group.spheres, false));
      each_other_kind([&](auto kind) { hash_.add(kind.of(group)); });
      hash_.add(group.instances);
    }
  }
  void add(const std::vector<Instance>& instances) {
    if (shares_) hash_.add(instances);
  }
  void add(const std::shared_ptr<const PackedSpheres>&) {}
  /// A scene without groups adds nothing, so that it keeps the hash that files already hold.
  void add(const OutlineGroups& groups) {
    if (!groups.empty()) hash_.add(groups);
  }

  /// The scene's own primitives of a kind, and those that its instances show.
  template <class Primitive>
  void add_with_shown(const std::vector<Primitive>& own) {
    hash_.add(PrimitiveKind<Primitive>::of(count_));
    for (const Primitive& one : own) hash_.add(one);
    if (shares_) return;
    visit_shown(scene_, std::function([this](const Primitive& one) { hash_.add(one); }));
  }

  std::uint64_t digest_of(const std::vector<Sphere>& spheres, bool shown_too) const {
    SphereDigest digest;
    digest.add(spheres, parallel_for_);
    if (shown_too)
      visit_shown(scene_, std::function([&](const Sphere& one) { digest.add({&one, 1}); }));
    return digest.value();
  }

  const Scene& scene_;
  const ParallelFor& parallel_for_;
  const PrimitiveCount count_ = count_primitives(scene_);
  bool shares_;
  Hasher hash_;
};

}  // namespace

std::uint64_t scene_hash(const Scene& scene, const ParallelFor& parallel_for) {
  const FloatEnvironment environment;
  return SceneHasher(scene, parallel_for).value();
}

}  // namespace boule
