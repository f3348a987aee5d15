// Packed scenes of any bytes, which are opened, walked and traced. Whole files are mostly zeros, up
// to the next page: an input has the sections without them, one after the other, and no checksums.
//
//   byte 0       how many sections, modulo 16
//   bytes 1-4    where the header is damaged, and by what: nowhere if the second is 0
//   each 4 bytes a section's kind and chunk, and the number of its bytes (16 bits)
//   the rest     the bytes of the sections
#include <algorithm>
#include <cstring>
#include <string>
#include <string_view>
#include <vector>

#include "render/files/packed/packed_file.h"
#include "render/prepare/extreme_spheres.h"
#include "render/prepare/scene_geometry.h"
#include "simd/dispatch/dispatch.h"
#include "simd/stream/stream_buffer.h"
#include "tests/fuzz/input_budget.h"
#include "tests/fuzz/input_folder.h"

namespace {

using namespace boule;
using fuzz::require;
using packed_format::Header;
using packed_format::page;

/// The fuzzer's bytes one after the other; behind the last there are none.
class Bytes {
 public:
  Bytes(const std::uint8_t* data, std::size_t size)
      : rest_(reinterpret_cast<const char*>(data), size) {}

  std::string_view take(std::size_t count) {
    const std::string_view taken = rest_.substr(0, count);
    rest_.remove_prefix(taken.size());
    return taken;
  }
  std::uint32_t number(std::size_t count) {
    std::uint32_t value = 0;
    const std::string_view taken = take(count);
    std::memcpy(&value, taken.data(), taken.size());
    return value;
  }

 private:
  std::string_view rest_;
};

/// The file that an input describes.
std::string file_of(Bytes bytes) {
  Header header{};
  std::copy_n(packed_format::magic, sizeof header.magic, header.magic);
  header.version = packed_format::version;
  header.sections = bytes.number(1) % 16;
  const std::uint32_t place = bytes.number(2), change = bytes.number(2);
  std::uint64_t end = page;
  for (std::uint32_t i = 0; i < header.sections; ++i) {
    auto& section = header.section[i];
    section.kind = static_cast<packed_format::Kind>(bytes.number(1));
    section.chunk = bytes.number(1);
    section.bytes = bytes.number(2);
    section.offset = end;
    end = packed_format::next_page(end + section.bytes);
  }
  header.file_bytes = end;
  std::string file(static_cast<std::size_t>(end), '\0');
  std::memcpy(file.data(), &header, sizeof header);
  for (std::uint32_t i = 0; i < header.sections; ++i) {
    const std::string_view content = bytes.take(static_cast<std::size_t>(header.section[i].bytes));
    content.copy(file.data() + header.section[i].offset, content.size());
  }
  char& damaged = file[place % (32 + 32 * 16)];
  damaged = static_cast<char>(damaged ^ static_cast<int>(change));
  return file;
}

/// Rays from all around to the middle of a scene.
std::vector<Ray> rays_to(const PackedSpheres& spheres) {
  const Vec3d middle = spheres.low * 0.5 + spheres.high * 0.5, size = spheres.high - spheres.low;
  std::vector<Ray> rays;
  for (int i = 0; i < 27; ++i) {
    const Vec3d side{i % 3 - 1.0, i / 3 % 3 - 1.0, i / 9 - 1.0};
    const Vec3d org{middle.x + side.x * size.x, middle.y + side.y * size.y,
                    middle.z + side.z * size.z};
    rays.push_back({org, vec_cast<float>(middle - org + Vec3d{0.01, 0.02, 0.03})});
  }
  return rays;
}

/// Every set of kernels meets the scene; what it meets is there.
void trace(const Scene& scene, const Geometry& geometry, const std::vector<Ray>& rays) {
  RayBuffer buffer(rays.size());
  for (std::size_t i = 0; i < rays.size(); ++i) buffer.set(i, rays[i]);
  HitBuffer hits(rays.size());
  AlignedArray<std::uint8_t> occluded(rays.size());
  for (const IsaInfo& isa : list_isas()) {
    if (!isa.supported) continue;
    const KernelTable& kernels = *select_kernels(isa.name).value();
    for (const Form form : {Form::packet, Form::single, Form::flight, Form::set}) {
      const Query query{Solver::robust, form, Coherence::none};
      kernels.closest_hit(geometry.view(), buffer.view(), query, hits.view());
      kernels.any_hit(geometry.view(), buffer.view(), query, occluded.data());
      for (std::size_t i = 0; i < rays.size(); ++i) {
        const Hit hit = hits.get(i);
        if (hit.id == no_primitive || geometry.is_plane(hit) || geometry.is_capsule(hit)) continue;
        require(geometry.sphere(hit.slot).material.index() < scene.materials.size(),
                "a sphere that is met is made of something");
      }
    }
  }
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const fuzz::InputBudget budget;
  static const fuzz::InputFolder folder;
  const std::string bytes = file_of({data, size});
  const std::string path = folder.write(
      "scene.boule", reinterpret_cast<const std::uint8_t*>(bytes.data()), bytes.size());
  const auto file = PackedFile::open(path);
  if (!file) {
    fuzz::require_good(file.error());
    return 0;
  }
  if (const Status done = file.value().verify(serial_for); !done) fuzz::require_good(done.error());
  auto scene = file.value().scene();
  if (!scene) {
    fuzz::require_good(scene.error());
    return 0;
  }
  require(validate(scene.value()).ok(), "a scene that was opened is valid");
  if (!scene.value().packed) return 0;
  const SphereMeasure measures[] = {{{0.6, 0, 0.8}, 1}, {{-0.6, 0.8, 0}, 0}};
  require(!extreme_spheres(*scene.value().packed, measures).empty(), "some sphere is outermost");
  const std::vector<Ray> rays = rays_to(*scene.value().packed);
  const Geometry geometry = geometry_of(scene.value(), std::nullopt, serial_for);
  trace(scene.value(), geometry, rays);
  return 0;
}
