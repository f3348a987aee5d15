// What NumPy users bring: rays in double precision, and spheres that are a scene by themselves.
#include <nlohmann/json.hpp>

#include "render/renderer/tracer.h"
#include "tests/render/apps/cli/trace/trace_program.h"

namespace boule::test {
namespace {

using testing::HasSubstr;
using testing::StartsWith;

using Npy = Trace;

/// `rays`, a little beside the numbers that a float32 has.
std::vector<RayRow> doubles_near(const std::vector<Ray>& rays) {
  std::vector<RayRow> rows;
  for (const Ray& ray : rays) {
    RayRow row = {ray.org.x, ray.org.y, ray.org.z, ray.tmin,
                  ray.dir.x, ray.dir.y, ray.dir.z, ray.tmax};
    for (double& x : row) x *= 1 + 0x1p-26;
    rows.push_back(row);
  }
  return rows;
}

TEST_F(Npy, DoubleOriginsAndEndsStayDoubles) {
  const std::string scene = cloud_scene(300);
  const std::vector<RayRow> rows = doubles_near(ray_cloud(5000));
  std::vector<Ray> rays;
  for (const RayRow& x : rows) {
    Ray ray{{x[0], x[1], x[2]}, vec_cast<float>(Vec3d{x[4], x[5], x[6]})};
    ray.tmin = x[3];
    ray.tmax = x[7];
    rays.push_back(ray);
  }
  Tracer tracer = Tracer::create(cloud(300)).value();
  std::vector<TracedHit> expected(rays.size());
  std::vector<std::uint8_t> met(rays.size());
  ASSERT_TRUE(tracer.closest(rays, expected));
  ASSERT_TRUE(tracer.any(rays, met));
  write("r.npy", ray_file64(rows));
  EXPECT_TRUE(hits(scene) == hit_file(expected));
  EXPECT_TRUE(hits(scene, {"--any-hit"}) == met_file(met));
}

TEST_F(Npy, DirectionsBeyondFloatAreMissesAndCounted) {
  const std::string scene = cloud_scene(3);
  const RayRow lost = {0, 0, 0, 0, 0, 0, 1e200, 1};
  const std::string rays = write("r.npy", ray_file64(std::vector<RayRow>{lost, lost}));
  const ProgramRun run = trace(scene, {});
  EXPECT_EQ(run.exit_code, 0);
  EXPECT_THAT(run.err,
              HasSubstr(rays + ": warning: 2 rays with a direction beyond the range of float32"));
  EXPECT_TRUE(read("h.npy") == hit_file({{}, {}}));
}

/// The same spheres by themselves and in a scene file.
class NpyScene : public Trace {
 protected:
  const std::string bare_ = write("bare.npy", sphere_file(sphere_cloud(20)));
  const std::string scene_ = write("scene.toml", "schema = 1\n[[spheres]]\nfile = \"bare.npy\"\n");

  std::string picture(const std::string& scene) const {
    const ProgramRun run = boule_run({"render", scene, "-o", path("p.exr"), "--size=64x36", "-q"});
    EXPECT_EQ(run.exit_code, 0) << run.err;
    return read("p.exr");
  }
};

TEST_F(NpyScene, IsTheSceneWithNothingElse) {
  EXPECT_TRUE(picture(bare_) == picture(scene_));
  write("r.npy", ray_file(ray_cloud(500)));
  EXPECT_TRUE(hits(bare_) == hits(scene_));
  auto bare = nlohmann::json::parse(boule_run({"info", bare_, "--json"}).out);
  auto scene = nlohmann::json::parse(boule_run({"info", scene_, "--json"}).out);
  EXPECT_EQ(bare.at("spheres"), 20);
  EXPECT_EQ(bare.at("file"), bare_);
  for (const char* key : {"file", "data_files"}) {
    bare.erase(key);
    scene.erase(key);
  }
  EXPECT_EQ(bare, scene);
}

TEST_F(NpyScene, IsNotReplaced) {
  write("r.npy", ray_file(ray_cloud(3)));
  const ProgramRun hits = refused_run({"trace", bare_, "--rays", path("r.npy"), "-o", bare_}, 2);
  EXPECT_THAT(hits.err, HasSubstr("the hits would replace '" + bare_.substr(0, 40)));
  refused_run({"render", bare_, "-o", path("x.png"), "--stats=json:" + bare_}, 2);
  refused_run(
      {"trace", bare_, "--rays", path("r.npy"), "-o", path("h.npy"), "--stats=json:" + bare_}, 2);
}

TEST_F(NpyScene, WhatIsNoneSaysWhatWouldBe) {
  const std::string centers(12, '\0'), row(20, '\0');
  const auto file = [](const std::string& shape, const std::string& data) {
    return npy_file(npy_dict("'<f4'", shape), data);
  };
  const std::pair<std::string, std::string> cases[] = {
      {file("(1, 3)", centers),
       "has 3 columns, centres alone: that needs a .toml scene with a key 'radius', or "
       "--input-format npy, which reads particles"},
      {file("(1, 5)", row),
       "has shape (1, 5), expected (N, 4): centre and radius; as particles it is read by "
       "--input-format npy"},
      {file("(1, 4)", row.substr(4)), "row 0: radius must be finite and above 0, is 0"},
      {"", "not a readable .npy file: it does not begin with \\x93NUMPY"}};
  for (const auto& [bytes, words] : cases) {
    const std::string scene = write("bad.npy", bytes);
    for (const std::vector<std::string>& arguments : std::vector<std::vector<std::string>>{
             {"render", scene, "-o", path("x.png")},
             {"trace", scene, "--rays", path("r.npy"), "-o", path("h.npy")},
             {"info", scene}}) {
      EXPECT_EQ(refused_run(arguments, 3).err, scene + ": error: " + words + "\n");
    }
  }
}

TEST_F(NpyScene, OfNoSpheresIsLegalAndTold) {
  const std::string note = "no objects in the scene: nothing to be hit";
  for (const std::string& scene :
       {write("none.npy", sphere_file({})), write("none.toml", "schema = 1\n[render]\n")}) {
    const ProgramRun run = boule_run({"render", scene, "-o", path("p.ppm"), "--size=8x8"});
    EXPECT_EQ(run.exit_code, 0) << run.err;
    EXPECT_THAT(run.err, HasSubstr("boule: note: " + note + "\n"));
    EXPECT_THAT(boule_run({"info", scene}).out, HasSubstr("\n  " + note + "\n"));
  }
}

TEST_F(NpyScene, HasFramesToo) {
  for (const char* name : {"d.07.npy", "d.08.npy"}) write(name, sphere_file(sphere_cloud(5)));
  const ProgramRun run = boule_run(
      {"render", path("d.##.npy"), "-o", path("d.#.ppm"), "--size=16x9", "--frames=7-8", "-q"});
  EXPECT_EQ(run.exit_code, 0) << run.err;
  EXPECT_EQ(read("d.7.ppm"), read("d.8.ppm"));
  EXPECT_THAT(read("d.7.ppm"), StartsWith("P6"));
}

}  // namespace
}  // namespace boule::test
