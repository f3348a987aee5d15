#include "render/renderer/scene_hash.h"

#include <gtest/gtest.h>

#include <cstdint>
#include <functional>
#include <optional>
#include <set>
#include <type_traits>
#include <variant>
#include <vector>

#include "tests/support/test_scenes.h"

namespace boule::test {
namespace {

/// The first changes nothing.
const std::function<void(Scene&)> changes[] = {
    [](Scene&) {},
    [](Scene& s) { s.camera.reset(); },
    [](Scene& s) { s.camera = OrthographicCamera{}; },
    [](Scene& s) { s.camera = FisheyeCamera{}; },
    [](Scene& s) {
      s.camera = FisheyeCamera{{}, 181};
    },
    [](Scene& s) { s.camera = LensCamera{}; },
    [](Scene& s) {
      s.camera = LensCamera{{}, {{1, 2, 3, 4}}};
    },
    [](Scene& s) {
      s.camera = LensCamera{{}, {{1, 2, 3, 5}}};
    },
    [](Scene& s) {
      s.camera = LensCamera{{}, {{1, 2, 3, 5}}, 24};
    },
    [](Scene& s) { s.camera = ThinLensCamera{}; },
    [](Scene& s) {
      s.camera = ThinLensCamera{{}, 45, FovAxis::x, 1, {}};
    },
    [](Scene& s) {
      s.camera = ThinLensCamera{{}, 45, FovAxis::x, 1, 2.0f};
    },
    [](Scene& s) {
      s.distortion = DistortionMap{2, 2, std::vector<float>(8, 0.5f)};
    },
    [](Scene& s) {
      s.distortion = DistortionMap{2, 2, std::vector<float>(8, 0.25f)};
    },
    [](Scene& s) { std::get<PinholeCamera>(*s.camera).fov = 51; },
    [](Scene& s) { std::get<PinholeCamera>(*s.camera).fov_axis = FovAxis::max; },
    [](Scene& s) { std::get<PinholeCamera>(*s.camera).pose.eye.x += 1; },
    [](Scene& s) { std::get<PinholeCamera>(*s.camera).pose.look_at.z += 1; },
    [](Scene& s) { std::get<PinholeCamera>(*s.camera).pose.up.x += 1; },
    [](Scene& s) { s.background = ConstantBackground{}; },
    [](Scene& s) { std::get<GradientBackground>(s.background).up.x = 1; },
    [](Scene& s) { std::get<GradientBackground>(s.background).top.r = 1; },
    [](Scene& s) { std::get<GradientBackground>(s.background).bottom.r = 0; },
    [](Scene& s) { s.ambient.b = 0; },
    [](Scene& s) { std::get<Matte>(s.materials[0].material).color.g = 0; },
    [](Scene& s) { std::get<Plastic>(s.materials[1].material).specular = 0; },
    [](Scene& s) { std::get<Plastic>(s.materials[1].material).shininess = 1; },
    [](Scene& s) { std::get<Plastic>(s.materials[1].material).reflect = 1; },
    [](Scene& s) {
      s.materials[2].material = Matte{{0.9f, 0.8f, 0.6f}};
    },  // metal's colour
    [](Scene& s) { std::get<Glass>(s.materials[3].material).ior = 2; },
    [](Scene& s) { std::get<Emissive>(s.materials[4].material).radiance.r = 1; },
    [](Scene& s) { std::get<Phong>(s.materials[5].material).ka = 1; },
    [](Scene& s) { std::get<Phong>(s.materials[5].material).kd = 1; },
    [](Scene& s) { std::get<Phong>(s.materials[5].material).ks = 1; },
    [](Scene& s) { std::get<Phong>(s.materials[5].material).transmission = 1; },
    [](Scene& s) { std::get<Phong>(s.materials[5].material).ior = 1; },
    [](Scene& s) { std::swap(s.lights[0], s.lights[1]); },
    [](Scene& s) { s.lights.pop_back(); },
    [](Scene& s) { std::get<PointLight>(s.lights[0]).falloff = Falloff::inverse_square; },
    [](Scene& s) { std::get<PointLight>(s.lights[0]).position.x = 0; },
    [](Scene& s) { std::get<DirectionalLight>(s.lights[2]).direction.x = 0; },
    [](Scene& s) { std::get<DirectionalLight>(s.lights[2]).intensity.r = 0; },
    [](Scene& s) { s.lights.emplace_back(SphereLight{}); },
    [](Scene& s) {
      s.lights.emplace_back(SphereLight{{0, 1, 0}});
    },
    [](Scene& s) {
      s.lights.emplace_back(SphereLight{{}, 2});
    },
    [](Scene& s) {
      s.lights.emplace_back(SphereLight{{}, 1, {1, 1, 2}});
    },
    [](Scene& s) { s.spheres[7].center.y += 0x1p-20f; },
    [](Scene& s) { s.spheres[7].radius += 0x1p-20f; },
    [](Scene& s) { s.spheres[7].material = 0; },
    [](Scene& s) { std::swap(s.spheres[0], s.spheres[1]); },
    [](Scene& s) { s.planes[0].point.y = 1; },
    [](Scene& s) { s.planes[0].normal.y = 1; },
    [](Scene& s) { s.planes[0].material = 0; },
    [](Scene& s) { s.planes.clear(); },
    [](Scene& s) { s.capsules = {{}}; },
    [](Scene& s) {
      s.capsules = {{}, {}};
    },
    [](Scene& s) { s.clips = {{}}; },
    [](Scene& s) {
      s.clips = {{}, {}};
    },
};

TEST(SceneHash, ChangesWithEveryValueThatShows) {
  std::set<std::uint64_t> seen;
  for (const auto& change : changes) {
    Scene scene = mixed_scene(8, 8);
    change(scene);
    EXPECT_TRUE(seen.insert(scene_hash(scene)).second) << "change " << seen.size();
  }
}

/// Makes a member another one.
void change(float& x) { x += 1; }
void change(MaterialRef& material) { material = material.index() + 1; }
void change(Vec3f& v) { v.y += 1; }
void change(Color& c) { c.b += 1; }
void change(std::optional<float>& x) { x = x.value_or(0) + 1; }
void change(std::vector<LensSurface>& surfaces) { surfaces.emplace_back(); }
void change(std::vector<Color>& pixels) { pixels.emplace_back(); }
void change(Both<int>& both) { both.second += 1; }
template <class Enum>
requires std::is_enum_v<Enum>
void change(Enum& value) { value = static_cast<Enum>(static_cast<int>(value) + 1); }
void change(CameraPose& pose) { pose.up.x += 1; }

/// Changes each field of a struct in turn: each gives the scene into which `put` puts the struct a
/// hash of its own.
template <class Struct, class Put>
void expect_hashes(const Put& put) {
  std::size_t count = 0;
  each_field<Struct>([&](const auto&) { ++count; });
  std::set<std::uint64_t> seen;
  for (std::size_t i = 0; i <= count; ++i) {
    Struct value;
    std::size_t at = 0;
    each_field(value, [&](const auto&, auto&& member) {
      if (at++ == i) change(member);
    });
    Scene scene;
    put(scene, value);
    seen.insert(scene_hash(scene));
  }
  EXPECT_EQ(seen.size(), count + 1) << fields<Struct>.type;
}

template <class... Kinds, class Put>
void expect_hashes(const std::variant<Kinds...>&, const Put& put) {
  (expect_hashes<Kinds>(put), ...);
}

/// Whatever field is added to a struct, the hash has it.
TEST(SceneHash, ChangesWithEveryListedField) {
  expect_hashes(Camera{}, [](Scene& s, const auto& camera) { s.camera = camera; });
  expect_hashes(Light{}, [](Scene& s, const auto& light) { s.lights = {light}; });
  expect_hashes(Material{}, [](Scene& s, const auto& material) {
    s.materials = {{"m", material}};
  });
  expect_hashes(Background{}, [](Scene& s, const auto& b) { s.background = b; });
  expect_hashes<Sphere>([](Scene& s, const Sphere& sphere) { s.spheres = {sphere}; });
  expect_hashes<Plane>([](Scene& s, const Plane& plane) { s.planes = {plane}; });
  expect_hashes<Clip>([](Scene& s, const Clip& clip) { s.clips = {clip}; });
  expect_hashes<Capsule>([](Scene& s, const Capsule& one) { s.capsules = {one}; });
}

TEST(SceneHash, LeavesOutNamesAndSettings) {
  const Scene scene = mixed_scene(8, 8);
  Scene other = mixed_scene(80, 60);
  other.image.spp = 9;
  other.render = {1, Method::path};
  for (NamedMaterial& material : other.materials) material.name += "'";
  EXPECT_EQ(scene_hash(other), scene_hash(scene));
}

/// The number is part of files: the same on every machine and in every version.
TEST(SceneHash, IsTheSameEverywhere) {
  Scene scene;
  scene.spheres.push_back({{1, 2, 3}, 4, 0});
  EXPECT_EQ(scene_hash(Scene{}), 7423417012350858287u);
  EXPECT_EQ(scene_hash(scene), 3518804662298390077u);
}

}  // namespace
}  // namespace boule::test
