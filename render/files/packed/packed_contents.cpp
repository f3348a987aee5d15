#include "render/files/packed/packed_contents.h"

#include <algorithm>

#include "core/scene/kinds.h"
#include "core/scene/scene_check.h"
#include "render/files/file/byte_fields.h"
#include "render/files/packed/packed_format.h"

namespace boule {

template <>
inline constexpr auto fields<PackedChunk> = field_list("chunk",
                                                       field("spheres", &PackedChunk::spheres),
                                                       field("scanned", &PackedChunk::scanned),
                                                       field("material", &PackedChunk::material));

namespace {

/// What is told of the spheres, with keys of its own: PackedSpheres has what is made of them, too.
struct Facts {
  std::uint64_t count = 0, digest = 0;
  bool has_own_colors = false;
  Vec3d low, high, origin;
  std::vector<std::uint64_t> made_of;
  std::vector<Sphere> emissive, first, extremes;
  std::vector<PackedChunk> chunks;
};

}  // namespace

template <>
inline constexpr auto fields<Facts> = field_list(
    "facts", field("count", &Facts::count), field("digest", &Facts::digest),
    field("has_own_colors", &Facts::has_own_colors), field("low", &Facts::low),
    field("high", &Facts::high), field("origin", &Facts::origin), field("made_of", &Facts::made_of),
    field("emissive", &Facts::emissive), field("first", &Facts::first),
    field("extremes", &Facts::extremes), field("chunks", &Facts::chunks));

namespace {

Diagnostic damaged() { return Diagnostic::of("its contents are damaged"); }

template <class Primitive>
bool are_valid(const std::vector<Primitive>& primitives, const Scene& scene) {
  return std::all_of(primitives.begin(), primitives.end(), [&](const Primitive& one) {
    return !find_problem(one) && one.material.index() < scene.materials.size();
  });
}

/// The sum of the chunks' spheres is the count, without overflow.
bool add_up(const PackedContents& contents) {
  std::uint64_t left = contents.spheres.count;
  for (const PackedChunk& chunk : contents.chunks) {
    if (chunk.spheres == 0 || chunk.spheres > packed_format::most_spheres) return false;
    if (chunk.spheres > left || chunk.material.index() >= contents.scene.materials.size())
      return false;
    left -= chunk.spheres;
  }
  return left == 0;
}

}  // namespace

std::string encode(const PackedContents& contents) {
  const PackedSpheres& s = contents.spheres;
  ByteWriter writer;
  writer.add(Facts{s.count, s.digest, s.has_own_colors, s.low, s.high, contents.origin, s.made_of,
                   s.emissive, s.first, s.extremes, contents.chunks});
  writer.add(contents.scene);
  return writer.bytes();
}

Result<PackedContents> decode(std::string_view bytes) {
  ByteReader reader(bytes);
  Facts facts;
  PackedContents contents;
  reader.read(facts);
  reader.read(contents.scene);
  if (!reader.unknown().empty()) {
    return Diagnostic::of("it holds " + quote(reader.unknown()) +
                          ", which this version of Boule does not know");
  }
  if (!reader.finished()) return damaged();
  PackedSpheres& own = contents.spheres;
  own.count = facts.count;
  own.digest = facts.digest;
  own.has_own_colors = facts.has_own_colors;
  own.low = facts.low;
  own.high = facts.high;
  own.made_of = std::move(facts.made_of);
  own.emissive = std::move(facts.emissive);
  own.first = std::move(facts.first);
  own.extremes = std::move(facts.extremes);
  contents.chunks = std::move(facts.chunks);
  contents.origin = facts.origin;
  const Scene& scene = contents.scene;
  if (auto done = validate_all_but_primitives(scene); !done) return done.error();
  if (!scene.spheres.empty() || !scene.groups.empty() || !scene.instances.empty()) return damaged();
  const PackedSpheres& spheres = contents.spheres;
  bool valid = true;
  each_other_kind([&](auto kind) { valid = valid && are_valid(kind.of(scene), scene); });
  valid = valid && are_valid(spheres.emissive, scene) && are_valid(spheres.first, scene) &&
          are_valid(spheres.extremes, scene) && spheres.extremes.empty() == (spheres.count == 0) &&
          add_up(contents) && spheres.made_of.size() == scene.materials.size();
  if (!valid) return damaged();
  return contents;
}

}  // namespace boule
