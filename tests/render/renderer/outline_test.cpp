// Dark lines where what the camera sees changes: against a search of all points for each point.
#include "render/renderer/outline.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numeric>
#include <tuple>
#include <vector>

#include "core/math/geometry.h"
#include "core/optics/camera_builder.h"
#include "core/optics/camera_ray.h"
#include "core/reference.h"
#include "render/renderer/scene_hash.h"
#include "simd/dispatch/dispatch.h"
#include "tests/render/picture_comparison.h"
#include "tests/support/test_scenes.h"

namespace boule::test {
namespace {

/// Balls that cut into each other, stand apart and stand before each other, over nothing.
Scene balls(int width, int height) {
  Scene scene = empty_scene(width, height);
  const auto matte = add_material(scene, Matte{});
  scene.spheres = {{{0, 0.3f, 0}, 0.8f, matte},
                   {{0.9f, 0, 0.2f}, 0.6f, matte},
                   {{-0.5f, -0.5f, 1}, 0.4f, matte},
                   {{-1.4f, 0.9f, 0}, 0.05f, matte}};
  scene.background = ConstantBackground{{0.5f, 0.6f, 0.7f}};
  scene.lights = {PointLight{{3, 5, 4}}};
  return scene;
}

/// What the points of the grid see, row by row.
std::vector<Hit> hits_of(const Scene& scene) {
  const CameraView view = build_camera(*scene.camera, scene.image.width, scene.image.height);
  std::vector<Hit> hits;
  for (int y = 0; y < scene.image.height * outline_grid; ++y) {
    for (int x = 0; x < scene.image.width * outline_grid; ++x) {
      const Ray ray = primary_ray(view, (x + 0.5) / outline_grid, (y + 0.5) / outline_grid);
      hits.push_back(reference::closest_hit(ray, scene.spheres, scene.planes));
      hits.back().t *= length(vec_cast<double>(ray.dir));
    }
  }
  return hits;
}

/// The middle between neighbours that see different things, and half the width of the line there.
struct Change {
  double x, y, reach;
};

/// Half the width of the line around what is nearer. Preconditions as for changes_of().
double reach_of(const Scene& scene, const Hit& a, const Hit& b) {
  const auto width = static_cast<double>(scene.image.outline);
  const Hit& nearer = b.t < a.t ? b : a;
  const auto id = static_cast<std::size_t>(nearer.id);
  const double tangent = std::tan(45 * 3.14159265358979 / 360);
  // What is near the middle of the picture is about as far away as it is deep.
  const double pixel = nearer.t * 2 * tangent / scene.image.width;
  const double most = outline_share * static_cast<double>(scene.spheres[id].radius) / pixel;
  return (most < width ? std::floor(2 * most) / 2 : width) / 2;
}

/// Preconditions: the camera is that of empty_scene(), and the scene has no planes.
std::vector<Change> changes_of(const Scene& scene) {
  const std::vector<Hit> hits = hits_of(scene);
  const int width = scene.image.width * outline_grid, height = scene.image.height * outline_grid;
  std::vector<Change> changes;
  const auto compare = [&](int x, int y, int dx, int dy) {
    if (x + dx >= width || y + dy >= height) return;
    const Hit& a = hits[static_cast<std::size_t>(y * width + x)];
    const Hit& b = hits[static_cast<std::size_t>((y + dy) * width + x + dx)];
    if (a.id == b.id) return;
    changes.push_back({(x + (1 + dx) / 2.0) / outline_grid, (y + (1 + dy) / 2.0) / outline_grid,
                       reach_of(scene, a, b)});
  };
  for (int y = 0; y < height; ++y) {
    for (int x = 0; x < width; ++x) {
      compare(x, y, 1, 0);
      compare(x, y, 0, 1);
    }
  }
  return changes;
}

/// The share of a pixel's points that lie on a line.
float line_share(const std::vector<Change>& changes, int x, int y) {
  int points = 0;
  for (int i = 0; i < outline_grid * outline_grid; ++i) {
    const double px = x + (i % outline_grid + 0.5) / outline_grid;
    const double py = y + (i / outline_grid + 0.5) / outline_grid;
    for (const Change& change : changes) {
      const double dx = px - change.x, dy = py - change.y;
      if (dx * dx + dy * dy > change.reach * change.reach) continue;
      ++points;
      break;
    }
  }
  return static_cast<float>(points) / (outline_grid * outline_grid);
}

class Lines : public testing::TestWithParam<float> {};

TEST_P(Lines, CoverPixelsNearAChange) {
  Scene scene = balls(90, 70);  // more than a block
  const Image plain = render(scene);
  scene.image.outline = GetParam();
  const Image picture = render(scene);
  const auto changes = changes_of(scene);
  int drawn = 0;
  for (int y = 0; y < 70; ++y) {
    for (int x = 0; x < 90; ++x) {
      const float left = 1 - line_share(changes, x, y);
      EXPECT_EQ(picture.at(x, y), plain.at(x, y) * left) << x << ' ' << y;
      drawn += left < 1 ? 1 : 0;
    }
  }
  EXPECT_GT(drawn, 100);
}

INSTANTIATE_TEST_SUITE_P(Widths, Lines, testing::Values(0.5f, 1.0f, 1.75f, 3.0f, 7.0f));

TEST(Outline, IgnoresThreadsTilesCropsAndIsa) {
  Scene scene = mixed_scene(150, 80);
  scene.image.outline = 2.5f;
  RenderOptions options = options_of(scene);
  const Image picture = render(scene, options);
  for (const IsaInfo& isa : list_isas()) {
    if (!isa.supported) continue;
    options.isa = isa.name;
    options.threads = 3;
    options.tile = 16;
    EXPECT_EQ(differing_pixels(picture, render(scene, options)), 0) << isa.name;
  }
  options.crop = PixelRect{37, 21, 101, 78};
  const Image part = render(scene, options);
  for (int y = 0; y < part.height; ++y) {
    for (int x = 0; x < part.width; ++x) EXPECT_EQ(part.at(x, y), picture.at(x + 37, y + 21));
  }
}

TEST(Outline, IsDrawnOntoPicturesOfFilms) {
  Scene scene = balls(40, 30);
  scene.image.outline = 1;
  auto renderer = Renderer::create(scene, options_of(scene));
  ASSERT_TRUE(renderer);
  const auto picture = renderer.value().render();
  Film film(renderer.value().rect());
  ASSERT_TRUE(renderer.value().render_pass(film, 1));
  Image of_film = film.to_image();
  const auto lines = renderer.value().render_outline();
  ASSERT_TRUE(lines);
  lines.value().draw(of_film);
  EXPECT_EQ(differing_pixels(of_film, picture.value()), 0);
}

TEST(Outline, RaisesAlpha) {
  Scene scene = balls(90, 70);
  scene.image.transparent = true;
  const Image plain = render(scene);
  scene.image.outline = 2;
  const Image picture = render(scene);
  const auto changes = changes_of(scene);
  int raised = 0;
  for (std::size_t i = 0; i < plain.alpha.size(); ++i) {
    const auto x = static_cast<int>(i % 90), y = static_cast<int>(i / 90);
    const float left = 1 - line_share(changes, x, y);
    EXPECT_EQ(picture.alpha[i], 1 - (1 - plain.alpha[i]) * left);
    raised += picture.alpha[i] > plain.alpha[i] ? 1 : 0;
  }
  EXPECT_GT(raised, 50);
}

TEST(Outline, LeavesSpecksUnchanged) {
  Scene scene = empty_scene(60, 50);
  const auto matte = add_material(scene, Matte{});
  for (int i = 0; i < 400; ++i) {
    const auto x = static_cast<float>(i % 20 - 10), y = static_cast<float>(i / 20 - 10);
    scene.spheres.push_back({{x * 0.15f, y * 0.15f, 0}, 0.06f, matte});
  }
  const Image plain = render(scene);
  scene.image.outline = 2;
  EXPECT_EQ(differing_pixels(render(scene), plain), 0);
}

TEST(Outline, WorksWhereFisheyeCornersAreEmpty) {
  Scene scene = balls(200, 200);
  FisheyeCamera fisheye;
  fisheye.pose = {{0, 0, 3}, {0, 0, 0}, {0, 1, 0}};
  fisheye.fov = 360;
  scene.camera = fisheye;
  const Image plain = render(scene);
  scene.image.outline = 1;
  EXPECT_GT(differing_pixels(render(scene), plain), 10);
}

/// A row of three balls that cut into each other, and one behind them.
Scene row_of_balls() {
  Scene scene = empty_scene(90, 70);
  const auto matte = add_material(scene, Matte{});
  scene.spheres = {{{-0.6f, 0, 0}, 0.5f, matte},
                   {{0, 0, 0}, 0.5f, matte},
                   {{0.6f, 0, 0}, 0.5f, matte},
                   {{0, 0.4f, -4}, 0.5f, matte}};
  scene.image.outline = 1;
  return scene;
}

/// The points of all pixels that lie on a line.
std::vector<int> line_points(const Scene& scene) {
  auto renderer = Renderer::create(scene, options_of(scene));
  const auto lines = renderer.value().render_outline();
  std::vector<int> points;
  for (int y = 0; y < scene.image.height; ++y)
    for (int x = 0; x < scene.image.width; ++x) points.push_back(lines.value().ink(x, y));
  return points;
}

TEST(Outline, FadesInFog) {
  Scene scene = row_of_balls();
  scene.spheres.back().center.y = 2;
  const std::vector<int> clear = line_points(scene);
  scene.image.fog = 0.5f;
  scene.image.fog_from = 0;
  scene.image.fog_to = 0.001f;  // all are behind it
  const std::vector<int> faint = line_points(scene);
  for (std::size_t i = 0; i < clear.size(); ++i) ASSERT_EQ(faint[i], (clear[i] + 1) / 2);
  scene.image.fog = 1;
  EXPECT_EQ(line_points(scene), std::vector<int>(clear.size(), 0));
  // What is behind the front balls fades, and these do not.
  const double eye = length(vec_cast<double>(std::get<PinholeCamera>(*scene.camera).pose.eye));
  scene.image.fog_from = static_cast<float>(eye + 0.6);
  scene.image.fog_to = static_cast<float>(eye + 0.7);
  const std::vector<int> some = line_points(scene);
  EXPECT_NE(some, clear);
  scene.spheres.pop_back();
  scene.image.fog = 0;
  EXPECT_EQ(line_points(scene), some);
}

TEST(Outline, GoesAroundGroups) {
  Scene scene = row_of_balls();
  const std::vector<int> of_objects = line_points(scene);
  const std::size_t row = 35 * 90;
  const auto on_joint = [&](const std::vector<int>& points, std::size_t begin, std::size_t end) {
    return std::accumulate(points.begin() + static_cast<std::ptrdiff_t>(row + begin),
                           points.begin() + static_cast<std::ptrdiff_t>(row + end), 0);
  };
  // The joints of the balls lie at x = -0.3 and 0.3, to either side of the middle.
  const auto left = [&](const auto& points) { return on_joint(points, 34, 44); };
  const auto right = [&](const auto& points) { return on_joint(points, 46, 56); };
  ASSERT_GT(left(of_objects), 0);
  ASSERT_GT(right(of_objects), 0);
  scene.outline_groups = {.spheres = {1, 1, 2, 0}, .largest = 2};
  const std::vector<int> of_groups = line_points(scene);
  EXPECT_EQ(left(of_groups), 0);
  EXPECT_EQ(right(of_groups), right(of_objects));
  // A list that ends early leaves the others by themselves.
  scene.outline_groups = {.spheres = {1, 1}, .largest = 1};
  EXPECT_EQ(line_points(scene), of_groups);
}

TEST(Outline, StaysWhereTheDepthJumps) {
  Scene scene = row_of_balls();
  scene.spheres.erase(scene.spheres.begin(), scene.spheres.begin() + 1);
  scene.spheres.erase(scene.spheres.begin() + 1);
  const std::vector<int> of_objects = line_points(scene);
  scene.outline_groups = {.spheres = {1, 1}, .largest = 1};
  EXPECT_EQ(line_points(scene), of_objects) << "4 apart, of radius 0.5";
  scene.spheres[1].center.z = -1.2f;
  EXPECT_NE(line_points(scene), of_objects);
  scene.outline_groups.spheres[1] = 2;
  const std::vector<int> apart = line_points(scene);
  scene.outline_groups.spheres[1] = 1;
  EXPECT_NE(line_points(scene), apart) << "1.2 apart";
}

TEST(Outline, IsOneAroundSphereAndRod) {
  Scene scene = row_of_balls();
  scene.spheres.resize(1);
  scene.capsules = {{{-0.6f, 0, 0}, {0.6f, 0, 0}, 0.2f, 0}};
  const std::vector<int> of_objects = line_points(scene);
  scene.outline_groups = {.spheres = {3}, .capsules = {3}, .largest = 3};
  const std::vector<int> of_group = line_points(scene);
  // Where the rod comes out of the ball there is a line no more; lines around groups may be wider.
  int gone = 0;
  for (std::size_t i = 0; i < of_objects.size(); ++i) gone += of_objects[i] > 0 && of_group[i] == 0;
  EXPECT_GT(gone, 0);
  scene.planes = {{{0, 0, -8}, {0, 0, 1}, 0}};  // comes before capsules in ids
  EXPECT_EQ(line_points(scene), of_group);
}

TEST(Outline, RefusesWrongWidths) {
  RenderOptions options;
  for (const float width : {-1.0f, 101.0f, std::nanf(""), HUGE_VALF}) {
    options.outline = width;
    const Status done = validate(options);
    ASSERT_FALSE(done) << width;
    EXPECT_EQ(done.error().key, "image.outline");
  }
}

}  // namespace
}  // namespace boule::test
