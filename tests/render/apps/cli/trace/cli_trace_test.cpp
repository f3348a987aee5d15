// Tracing from the command line: the hits are the library's, and what is told beside them.
#include <limits>
#include <nlohmann/json.hpp>

#include "core/reference.h"
#include "core/surface.h"
#include "render/renderer/tracer.h"
#include "simd/dispatch/dispatch.h"
#include "simd/geometry/geometry.h"
#include "simd/stream/stream_buffer.h"
#include "tests/render/apps/cli/trace/trace_program.h"

namespace boule::test::cli_trace {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::Not;
using testing::StartsWith;

constexpr float inf = std::numeric_limits<float>::infinity();

/// Whether the hit is the first of the two that a line has.
bool enters(const Scene& scene, const Ray& ray, const Hit& hit) {
  const auto i = static_cast<std::size_t>(hit.id);
  const bool is_sphere = i < scene.spheres.size();
  const reference::Chord chord =
      is_sphere ? reference::find_chord(ray, scene.spheres[i], false)
                : reference::find_chord(ray, scene.planes[i - scene.spheres.size()], false);
  return hit.t - chord.enter <= chord.leave - hit.t;
}

/// The library's own hits, by the kernels and the shading's normals.
std::vector<TracedHit> kernel_hits(const Scene& scene, const std::vector<Ray>& rays,
                                   const std::string& isa, Solver solver) {
  const Geometry geometry(scene.spheres, scene.planes);
  RayBuffer stream(rays.size());
  for (std::size_t i = 0; i < rays.size(); ++i) stream.set(i, rays[i]);
  HitBuffer found(rays.size());
  select_kernels(isa).value()->closest_hit(geometry.view(), stream.view(), {solver}, found.view());
  std::vector<TracedHit> hits;
  for (std::size_t i = 0; i < rays.size(); ++i) {
    const Hit hit = found.get(i);
    hits.push_back({hit.t, hit.id, {}});
    if (hit.id == no_primitive) continue;
    const Surface surface = find_surface(scene.spheres, scene.planes, rays[i], hit);
    hits.back().normal = vec_cast<float>(surface.normal);
    hits.back().entering = enters(scene, rays[i], hit);
  }
  return hits;
}

std::vector<std::uint8_t> met_of(const std::vector<TracedHit>& hits) {
  std::vector<std::uint8_t> met;
  for (const TracedHit& hit : hits) met.push_back(hit.id == no_primitive ? 0 : 1);
  return met;
}

TEST_F(Trace, HitsMatchTheLibraryInEveryConfiguration) {
  const std::string scene = cloud_scene(1000);
  const std::vector<Ray> rays = ray_cloud(100'003);
  write("r.npy", ray_file(rays));
  const auto exact = kernel_hits(cloud(1000), rays, "auto", Solver::robust);
  const std::string expected = hit_file(exact), expected_met = met_file(met_of(exact));
  for (const IsaInfo& one : list_isas()) {
    if (!one.supported) continue;
    const std::string isa(one.name);
    for (const char* threads : {"0", "1", "2", "5"}) {
      EXPECT_TRUE(hits(scene, {"--isa", isa, "-t", threads}) == expected) << isa << " " << threads;
    }
    EXPECT_TRUE(hits(scene, {"--isa", isa, "--any-hit"}) == expected_met) << isa;
    const auto fast = kernel_hits(cloud(1000), rays, isa, Solver::fast);
    EXPECT_TRUE(hits(scene, {"--isa", isa, "--solver", "fast"}) == hit_file(fast)) << isa;
    EXPECT_TRUE(hits(scene, {"--isa", isa, "--solver", "fast", "--any-hit"}) ==
                met_file(met_of(fast)))
        << isa;
  }
  EXPECT_TRUE(hits(scene, {"--solver", "robust"}) == expected);
  EXPECT_TRUE(hits(scene, {"--solver", "reference"}) == expected);
  EXPECT_TRUE(hits(scene, {"--solver", "reference", "--any-hit", "--threads", "2"}) ==
              expected_met);
}

/// The answers of a tracer as the bytes of their files.
std::string all_file(const Crossings& all) {
  std::string data;
  for (std::size_t ray = 0; ray + 1 < all.offset.size(); ++ray) {
    for (auto k = static_cast<std::size_t>(all.offset[ray]);
         k < static_cast<std::size_t>(all.offset[ray + 1]); ++k) {
      append_bytes(data, static_cast<std::int64_t>(ray));
      append_bytes(data, all.t[k]);
      append_bytes(data, all.id[k]);
      append_bytes(data, all.entering[k]);
    }
  }
  return npy_file(
      hit_dict("[('ray', '<i8'), ('t', '<f8'), ('id', '<i4'), ('entering', '|b1')]", all.t.size()),
      data);
}
template <class Number>
std::string numbers_file(const std::string& descr, const std::vector<Number>& numbers) {
  std::string data;
  for (const Number number : numbers) append_bytes(data, number);
  return npy_file(hit_dict(descr, numbers.size()), data);
}

TEST_F(Trace, CrossingsCountsAndChordsAreTheLibrarys) {
  const std::string scene = cloud_scene(3000);
  const std::vector<Ray> rays = ray_cloud((1 << 18) + 999);  // more than one chunk
  write("r.npy", ray_file(rays));
  Tracer tracer = Tracer::create(cloud(3000)).value();
  const Crossings all = tracer.all_hits(rays).value();
  EXPECT_GT(all.t.size(), rays.size());
  EXPECT_TRUE(hits(scene, {"--all-hits"}) == all_file(all));
  EXPECT_TRUE(hits(scene, {"--all-hits", "--limit", "2"}) ==
              all_file(tracer.all_hits(rays, 2).value()));
  std::vector<std::int64_t> counts(rays.size());
  ASSERT_TRUE(tracer.count(rays, counts));
  EXPECT_TRUE(hits(scene, {"--count"}) == numbers_file("'<i8'", counts));
  std::vector<double> lengths(rays.size());
  ASSERT_TRUE(tracer.chord(rays, lengths));
  EXPECT_TRUE(hits(scene, {"--chord"}) == numbers_file("'<f8'", lengths));
  EXPECT_THAT(
      refused_run(
          {"trace", scene, "--rays", path("r.npy"), "-o", path("h.npy"), "--count", "--chord"}, 2)
          .err,
      HasSubstr("excludes"));
  EXPECT_THAT(
      refused_run({"trace", scene, "--rays", path("r.npy"), "-o", path("h.npy"), "--limit", "2"}, 2)
          .err,
      HasSubstr("--limit requires --all-hits"));
}

TEST_F(Trace, SourcesInTheFileAreLeft) {
  const auto file = [this](double source, double inside) {
    std::string data;
    for (const double x : {1.0, 1.0, 0.0, 0.0, 1.0, 0.0, 0.0, double{inf}, source, inside})
      append_bytes(data, x);
    write("r.npy", npy_file(npy_dict("'<f8'", "(1, 10)"), data));
  };
  // The small scene has a sphere of radius 1 around (0, 1, 0), and a plane.
  file(-1, 0);
  EXPECT_TRUE(hits(small_scene(), {"--count"}) == numbers_file<std::int64_t>("'<i8'", {0}));
  file(0, 0);
  EXPECT_TRUE(hits(small_scene(), {"--count"}) == numbers_file<std::int64_t>("'<i8'", {0}));
  for (const auto& [source, inside, error] :
       {std::tuple(2.0, 0.0, "row 0: must be -1 or an id below 2, is 2 (key 'source')"),
        std::tuple(0.5, 0.0, "is 0.5 (key 'source')"),
        std::tuple(0.0, 2.0, "row 0: must be 0 or 1, is 2 (key 'inside')")}) {
    file(source, inside);
    const ProgramRun run =
        refused_run({"trace", small_scene(), "--rays", path("r.npy"), "-o", path("h.npy")}, 3);
    EXPECT_THAT(run.err, HasSubstr("r.npy: error: "));
    EXPECT_THAT(run.err, HasSubstr(error));
  }
}

TEST_F(Trace, AFileOfSeveralChunksIsOne) {
  const std::string scene = cloud_scene(20);
  const std::vector<Ray> rays = ray_cloud(2 * (1 << 18) + 12'345);
  write("r.npy", ray_file(rays));
  const auto expected = kernel_hits(cloud(20), rays, "auto", Solver::robust);
  EXPECT_TRUE(hits(scene) == hit_file(expected));
  EXPECT_TRUE(hits(scene, {"--any-hit"}) == met_file(met_of(expected)));
  const ProgramRun run = trace(scene, {"--progress", "json", "--stats", "json"});
  EXPECT_EQ(nlohmann::json::parse(run.out).at("rays").at("count"), rays.size());
  std::istringstream lines(run.err);
  double last = 0;
  for (std::string line; std::getline(lines, line) && line[0] == '{';) {
    const double share = nlohmann::json::parse(line).at("share").get<double>();
    EXPECT_GE(share, last);
    last = share;
  }
  EXPECT_EQ(last, 1);
}

TEST_F(Trace, ExactlyOneChunkIsWhole) {
  const std::string scene = cloud_scene(3);
  const std::vector<Ray> rays = ray_cloud(1 << 18);
  write("r.npy", ray_file(rays));
  EXPECT_TRUE(hits(scene) == hit_file(kernel_hits(cloud(3), rays, "auto", Solver::robust)));
}

TEST_F(Trace, NoRaysAreNoHits) {
  write("r.npy", ray_file({}));
  EXPECT_TRUE(hits(small_scene()) == hit_file({}));
  EXPECT_TRUE(hits(small_scene(), {"--any-hit"}) == met_file({}));
  const ProgramRun run = trace(small_scene(), {});
  EXPECT_EQ(run.exit_code, 0);
  EXPECT_THAT(run.err, HasSubstr("h.npy: 0 rays, 0 hits"));
}

TEST_F(Trace, NanAndInfAreMisses) {
  std::vector<Ray> rays;
  for (const float bad : {inf, -inf, std::numeric_limits<float>::quiet_NaN()}) {
    rays.push_back({{0, static_cast<double>(bad), 5}, {0, 0, -1}});
    rays.push_back({{0, 1, 5}, {bad, 0, -1}});
  }
  Ray no_end{{0, 1, 5}, {0, 0, -1}};
  no_end.tmax = std::numeric_limits<float>::quiet_NaN();
  rays.push_back(no_end);
  const std::vector<TracedHit> misses(rays.size());
  write("r.npy", ray_file(rays));
  for (const char* solver : {"fast", "robust", "reference"}) {
    EXPECT_TRUE(hits(small_scene(), {"--solver", solver}) == hit_file(misses)) << solver;
    EXPECT_TRUE(hits(small_scene(), {"--solver", solver, "--any-hit"}) == met_file(met_of(misses)))
        << solver;
  }
}

TEST_F(Trace, PlaneIdsFollowSpheresNormalsFaceRays) {
  write("r.npy",
        ray_file({{{0, 1, 5}, {0, 0, -2}}, {{3, 1, 0}, {0, -1, 0}}, {{3, -1, 0}, {0, 0.5f, 0}}}));
  const std::vector<TracedHit> expected = {
      {2, 0, {0, 0, 1}, true}, {1, 1, {0, 1, 0}, true}, {2, 1, {-0.0f, -1, -0.0f}}};
  EXPECT_TRUE(hits(small_scene()) == hit_file(expected));
}

TEST_F(Trace, HitsNeverReplaceAnInput) {
  const std::string scene = cloud_scene(20), rays = write("r.npy", ray_file(ray_cloud(3)));
  std::filesystem::create_hard_link(rays, path("link.npy"));
  for (const std::string& output : {rays, path("link.npy"), path("cloud.npy")}) {
    const ProgramRun run = refused_run({"trace", scene, "--rays", rays, "-o", output}, 2);
    EXPECT_THAT(run.err, testing::HasSubstr("the hits would replace '"));
  }
}

TEST_F(Trace, NeedsNeitherCameraNorLight) {
  write("r.npy", ray_file(ray_cloud(10)));
  const ProgramRun run = trace(cloud_scene(3), {"--progress", "none"});
  EXPECT_EQ(run.exit_code, 0);
  EXPECT_THAT(run.out, IsEmpty());
  EXPECT_THAT(run.err, StartsWith("boule: " + path("h.npy") + ": 10 rays, "));
  EXPECT_EQ(std::count(run.err.begin(), run.err.end(), '\n'), 1) << run.err;
  // Nothing that could be framed.
  const std::string wide = write("wide.toml",
                                 "schema = 1\n[[sphere]]\ncenter = [3e38, 0, 0]\nradius = 3e38\n"
                                 "[[sphere]]\ncenter = [-3e38, 3e38, 0]\nradius = 1e38\n");
  EXPECT_NE(boule_run({"render", wide, "-o", path("x.png")}).exit_code, 0);
  EXPECT_THAT(trace(wide, {"-v"}).err, Not(HasSubstr("camera")));
  EXPECT_EQ(trace(write("empty.toml", "schema = 1\n"), {}).exit_code, 0);
}

TEST_F(Trace, ParticlesAreTheSpheresThatRenderShows) {
  write("r.npy", ray_file({{{0, 0, 9}, {0, 0, -1}}, {{3, 0, 9}, {0, 0, -1}}}));
  const std::string file = write("p.xyz", "1\n\nC 0 0 0\n2\n\nC 3 0 0\nO 0 0 1\n");
  // The last frame, and the first; carbon has a van der Waals radius of 1.77.
  EXPECT_TRUE(hits(file, {"--radius", "0.5"}) ==
              hit_file({{7.5, 1, {0, 0, 1}, true}, {8.5, 0, {0, 0, 1}, true}}));
  EXPECT_TRUE(hits(file, {"--frame", "0", "--radius", "1", "--scale", "0.5"}) ==
              hit_file({{8.5, 0, {0, 0, 1}, true}, {inf, -1, {}}}));
  EXPECT_TRUE(hits(file, {"--radius", "0.5", "--select", "species == \"C\""}) ==
              hit_file({{inf, -1, {}}, {8.5, 0, {0, 0, 1}, true}}));
  const std::vector<std::string> base = {"trace", small_scene(), "--rays",   path("r.npy"),
                                         "-o",    path("h.npy"), "--radius", "1"};
  EXPECT_THAT(refused_run(base, 2).err, HasSubstr("is of particle files"));
}

TEST_F(Trace, NffScenesAndTheirWarnings) {
  write("r.npy", ray_file({{{0, 0, 9}, {0, 0, -1}}, {{5, 0, 9}, {0, 0, -1}}}));
  const std::string scene = write("s.nff",
                                  "v\nfrom 0 -5 2\nat 0 0 0\nup 0 0 1\nangle 45\nhither 1\n"
                                  "resolution 16 9\nf 1 0 0 1 0 0 0 1\np 3\n-1 -1 0\n1 -1 0\n"
                                  "0 1 0\ns 0 0 1 0.5\n");
  EXPECT_THAT(trace(scene, {}).err, HasSubstr("s.nff:9: warning: "));
  EXPECT_TRUE(hits(scene) == hit_file({{7.5, 0, {0, 0, 1}, true}, {9, 1, {0, 0, 1}, true}}));
}

TEST_F(Trace, StatisticsAreThoseOfATrace) {
  write("r.npy", ray_file(ray_cloud(5000)));
  const ProgramRun run =
      trace(cloud_scene(10), {"-q", "--stats", "json", "-t", "5", "--isa", "scalar"});
  ASSERT_EQ(run.exit_code, 0) << run.err;
  const auto stats = nlohmann::json::parse(run.out);
  EXPECT_EQ(stats.size(), 10u);
  EXPECT_EQ(stats.at("schema"), 1);
  EXPECT_TRUE(stats.at("version").is_string());
  EXPECT_EQ(stats.at("isa"), "scalar");
  EXPECT_EQ(stats.at("width"), 1);
  EXPECT_EQ(stats.at("solver"), "robust");
  EXPECT_EQ(stats.at("threads"), 5);  // of 1024 rays each, at most
  const auto& seconds = stats.at("seconds");
  EXPECT_EQ(seconds.size(), 5u);
  double sum = 0;
  for (const char* part : {"load", "prepare", "trace", "write"}) {
    EXPECT_GT(seconds.at(part).get<double>(), 0) << part;
    sum += seconds.at(part).get<double>();
  }
  EXPECT_LE(sum, seconds.at("total").get<double>());
  EXPECT_EQ(stats.at("rays"), nlohmann::json({{"count", 5000}}));
  EXPECT_DOUBLE_EQ(stats.at("mrays_per_s").get<double>(),
                   5000 / seconds.at("trace").get<double>() * 1e-6);
  EXPECT_GT(stats.at("peak_rss_mib").get<double>(), 1);

  EXPECT_THAT(trace(cloud_scene(10), {"--stats", "json:" + path("s.json")}).out, IsEmpty());
  EXPECT_EQ(nlohmann::json::parse(read("s.json")).at("rays").at("count"), 5000);
  const ProgramRun text = trace(cloud_scene(10), {"-q", "--stats", "text"});
  EXPECT_THAT(text.out, IsEmpty());
  for (const char* part : {"solver robust", "load ", "prepare ", "trace ", "write ", "total ",
                           "rays: 5000, ", "Mray/s", "MiB"}) {
    EXPECT_THAT(text.err, HasSubstr(part));
  }
  EXPECT_THAT(text.err, Not(HasSubstr("pixels")));
}

TEST_F(Trace, ProgressAndNotes) {
  write("r.npy", ray_file(ray_cloud(5000)));
  const std::string scene = cloud_scene(10);
  EXPECT_THAT(trace(scene, {"--progress", "bar"}).err, StartsWith("\rboule: "));
  EXPECT_THAT(trace(scene, {"--progress", "auto"}).err, Not(HasSubstr("\r")));
  EXPECT_THAT(trace(scene, {"--progress", "plain"}).err, Not(HasSubstr("\r")));
  EXPECT_THAT(trace(scene, {"--progress", "json"}).err, HasSubstr("{\"share\":1.0000,"));
  EXPECT_THAT(trace(scene, {"--progress", "none"}).err, Not(HasSubstr("%")));
  EXPECT_THAT(trace(scene, {"--progress", "bar", "-q"}).err, IsEmpty());
  const ProgramRun run = trace(scene, {"-v"});
  for (const char* part :
       {"cloud.toml: 10 spheres, 2 planes, ", "note: prepared in ", "note: written in "}) {
    EXPECT_THAT(run.err, HasSubstr(part));
  }
}

TEST_F(Trace, NothingOfOpenImageIoIsLoaded) {
  write("r.npy", ray_file(ray_cloud(10)));
  const ProgramRun run =
      boule_run({"trace", small_scene(), "--rays", path("r.npy"), "-o", path("h.npy")},
                {"LD_DEBUG=files", "LD_DEBUG_OUTPUT=" + path("loaded")});
  EXPECT_EQ(run.exit_code, 0);
  std::string loaded;
  for (const std::string& name : files()) {
    if (name.starts_with("loaded.")) loaded += read(name);
  }
  EXPECT_THAT(loaded, HasSubstr("libstdc++"));
  EXPECT_THAT(loaded, Not(HasSubstr("OpenImageIO")));
  EXPECT_THAT(loaded, Not(HasSubstr("boule_image_io")));
}

TEST_F(Trace, HelpNamesEveryOption) {
  const ProgramRun run = boule_run({"trace", "--help"});
  EXPECT_EQ(run.exit_code, 0);
  EXPECT_THAT(run.err, IsEmpty());
  for (const char* option :
       {"--rays", "--points", "--nearest", "--inside", "--within", "--pairs", "--output",
        "--any-hit", "--all-hits", "--count", "--chord", "--isa", "--solver", "--threads",
        "--progress", "--stats", "--quiet", "--verbose"}) {
    EXPECT_THAT(run.out, HasSubstr(option));
  }
}

}  // namespace
}  // namespace boule::test::cli_trace
