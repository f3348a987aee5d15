// `boule trace` about points and pairs of spheres: the answers are the library's.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <limits>
#include <nlohmann/json.hpp>

#include "render/renderer/tracer.h"
#include "tests/render/apps/cli/trace/trace_program.h"

namespace boule::test::cli_points {
namespace {

using testing::HasSubstr;

constexpr double inf = std::numeric_limits<double>::infinity();

class TracePoints : public Trace {};

/// float64, N x 3.
std::string point_file(const std::vector<Vec3d>& points) {
  std::string data;
  for (const Vec3d& point : points) {
    for (const double x : {point.x, point.y, point.z}) append_bytes(data, x);
  }
  return npy_file(npy_dict("'<f8'", "(" + std::to_string(points.size()) + ", 3)"), data);
}

TEST_F(TracePoints, PointsAndPairsAreTheLibrarys) {
  const std::string scene = cloud_scene(500);
  std::vector<Vec3d> points;
  for (const Ray& ray : ray_cloud((1 << 17) + 99)) points.push_back(ray.org);  // chunks of nearest
  write("p.npy", point_file(points));
  const auto answers = [&](Arguments options) {
    options.insert(options.begin(), {"trace", scene, "-q", "-o", path("h.npy")});
    const ProgramRun run = boule_run(options);
    EXPECT_EQ(run.exit_code, 0) << run.err;
    return read("h.npy");
  };
  Tracer tracer = Tracer::create(cloud(500)).value();
  std::vector<double> distance(3 * points.size());
  std::vector<std::int32_t> id(distance.size());
  ASSERT_TRUE(tracer.nearest(points, 3, 0.5, {distance.data(), id.data()}));
  std::string data;
  for (std::size_t k = 0; k < id.size(); ++k) {
    append_bytes(data, distance[k]);
    append_bytes(data, id[k]);
  }
  const std::string found =
      answers({"--points", path("p.npy"), "--nearest", "3", "--within", "0.5"});
  EXPECT_THAT(found, HasSubstr("'shape': (" + std::to_string(points.size()) + ", 3)"));
  EXPECT_THAT(found, HasSubstr("[('distance', '<f8'), ('id', '<i4')]"));
  EXPECT_TRUE(found.substr(128) == data);
  for (const double radius : {0.0, 0.25}) {
    const Members members = tracer.within(points, radius).value();
    data.clear();
    for (std::size_t row = 0; row < points.size(); ++row) {
      for (auto k = members.offset[row]; k < members.offset[row + 1]; ++k) {
        append_bytes(data, static_cast<std::int64_t>(row));
        append_bytes(data, members.id[static_cast<std::size_t>(k)]);
      }
    }
    Arguments options = {"--points", path("p.npy"), "--inside"};
    if (radius > 0) options = {"--points", path("p.npy"), "--within", "0.25"};
    EXPECT_TRUE(answers(options) ==
                npy_file(hit_dict("[('point', '<i8'), ('id', '<i4')]", members.id.size()), data));
  }
  const SpherePairs pairs = tracer.pairs(0.1).value();
  data.clear();
  for (std::size_t k = 0; k < pairs.gap.size(); ++k) {
    append_bytes(data, pairs.first[k]);
    append_bytes(data, pairs.second[k]);
    append_bytes(data, pairs.gap[k]);
  }
  EXPECT_GT(pairs.gap.size(), 10U);
  const std::string descr = "[('first', '<i4'), ('second', '<i4'), ('gap', '<f8')]";
  EXPECT_TRUE(answers({"--pairs", "0.1"}) == npy_file(hit_dict(descr, pairs.gap.size()), data));
}

TEST_F(TracePoints, StatisticsCountPoints) {
  write("p.npy", point_file({{}, {1, 2, 3}}));
  Arguments options = {"trace", small_scene(), "-o", path("h.npy"), "--points", path("p.npy")};
  options.insert(options.end(), {"--stats", "json"});
  const ProgramRun run = boule_run(options);
  const auto stats = nlohmann::json::parse(run.out);
  EXPECT_EQ(stats.at("points").at("count"), 2);
  EXPECT_EQ(stats.at("rays").at("count"), 0);
  EXPECT_GT(stats.at("mpoints_per_s").get<double>(), 0);
  options.back() = "text";
  EXPECT_THAT(boule_run(options).err, HasSubstr("stats: points: 2, "));
}

TEST_F(TracePoints, WrongPointsAreRefused) {
  const std::string scene = small_scene();
  const auto refused = [&](Arguments options, int code) {
    options.insert(options.begin(), {"trace", scene, "-o", path("h.npy")});
    return refused_run(options, code).err;
  };
  write("p.npy", point_file({{}, {0, inf, 0}}));
  write("r.npy", ray_file(ray_cloud(2)));
  EXPECT_THAT(refused({"--points", path("p.npy")}, 3), HasSubstr("p.npy: error: row 1: must be"));
  EXPECT_THAT(refused({"--points", path("r.npy")}, 3), HasSubstr("expected (N, 3)"));
  EXPECT_THAT(refused({"--points", path("none.npy")}, 3), HasSubstr("none.npy"));
  EXPECT_THAT(refused({}, 2), HasSubstr("expected --rays, --points or --pairs"));
  EXPECT_THAT(refused({"--rays", path("r.npy"), "--inside"}, 2), HasSubstr("requires --points"));
  EXPECT_THAT(refused({"--points", path("p.npy"), "--count"}, 2), HasSubstr("requires --rays"));
  EXPECT_THAT(refused({"--points", path("p.npy"), "--pairs", "1"}, 2), HasSubstr("excludes"));
  EXPECT_THAT(refused({"--pairs", "near"}, 2), HasSubstr("expected a number"));
  EXPECT_THAT(refused({"--points", path("p.npy"), "--nearest", "0"}, 2), HasSubstr("'0'"));
}

}  // namespace
}  // namespace boule::test::cli_points
