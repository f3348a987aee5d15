// Files of rays and hits.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <limits>

#include "render/files/trace_file/hit_file.h"
#include "render/files/trace_file/ray_file.h"
#include "tests/render/npy_files.h"
#include "tests/render/ray_clouds.h"
#include "tests/support/case_random.h"
#include "tests/support/file_bytes.h"
#include "tests/support/temp_dir.h"

namespace boule::test {
namespace {

class TraceFiles : public testing::Test {
 protected:
  [[nodiscard]] std::string path(const std::string& name) const {
    return (folder_.path() / name).string();
  }
  [[nodiscard]] std::string write(const std::string& name, const std::string& bytes) const {
    write_bytes(path(name), bytes);
    return path(name);
  }
  [[nodiscard]] std::string read(const std::string& name) const { return read_bytes(path(name)); }
  [[nodiscard]] std::size_t file_count() const {
    const std::filesystem::directory_iterator entries(folder_.path());
    return static_cast<std::size_t>(std::distance(begin(entries), end(entries)));
  }

 private:
  TempDir folder_;
};

TEST_F(TraceFiles, RaysSurviveAnySplit) {
  std::vector<Ray> rays = ray_cloud(10'000);
  rays[17].tmax = std::numeric_limits<float>::infinity();
  rays[18].dir.y = std::numeric_limits<float>::quiet_NaN();
  const std::string name = write("r.npy", ray_file(rays));
  for (const std::size_t piece : {std::size_t{1}, std::size_t{4096}, std::size_t{9'999}}) {
    auto file = RayFile::open(name);
    ASSERT_TRUE(file) << format_diagnostic(file.error());
    ASSERT_EQ(file.value().size(), rays.size());
    std::vector<Ray> found(rays.size());
    const std::span<Ray> all(found);
    for (std::size_t first = 0; first < rays.size(); first += piece) {
      const auto part = all.subspan(first, std::min(piece, rays.size() - first));
      ASSERT_TRUE(file.value().read(part));
    }
    EXPECT_TRUE(ray_rows(found) == ray_rows(rays)) << piece;
    EXPECT_EQ(found[5].source, no_primitive);
    EXPECT_FALSE(found[5].inside);
  }
}

/// The rays that are read from a file of float64.
std::vector<Ray> read_rays(RayFile& file) {
  std::vector<Ray> rays(file.size());
  EXPECT_TRUE(file.read(rays));
  return rays;
}

TEST_F(TraceFiles, OnlyDirectionsAreRoundedToNearest) {
  CaseRandom random(31);
  std::vector<RayRow> rows;
  for (int i = 0; i < 10'000; ++i) {
    RayRow row{};
    for (double& x : row) x = random.uniform(-1, 1) * std::pow(2.0, random.uniform(-100, 100));
    rows.push_back(row);
  }
  rows[0][4] = 1 + 0x1p-24;  // halfway between two floats: the even one
  rows[1][4] = 1 + 0x1p-24 + 0x1p-50;
  auto file = RayFile::open(write("r.npy", ray_file64(rows)));
  ASSERT_TRUE(file) << format_diagnostic(file.error());
  const std::vector<Ray> found = read_rays(file.value());
  for (std::size_t i = 0; i < found.size(); ++i) {
    const RayRow& row = rows[i];
    ASSERT_EQ(found[i].org, (Vec3d{row[0], row[1], row[2]}));
    ASSERT_EQ(found[i].dir, vec_cast<float>(Vec3d{row[4], row[5], row[6]}));
    ASSERT_EQ(found[i].tmin, row[3]);
    ASSERT_EQ(found[i].tmax, row[7]);
  }
  EXPECT_EQ(found[0].dir.x, 1);
  EXPECT_EQ(found[1].dir.x, 1 + 0x1p-23);
  EXPECT_EQ(file.value().lost(), 0u);
}

TEST_F(TraceFiles, SourcesAreReadAndChecked) {
  const auto open = [this](double source, double inside) {
    std::string data;
    for (const double last : {0.0, source}) {
      for (const double x : {1.0, 2.0, 3.0, 0.0, 0.0, 0.0, 1.0, 9.0, last}) append_bytes(data, x);
      append_bytes(data, inside);
    }
    return RayFile::open(write("r.npy", npy_file(npy_dict("'<f8'", "(2, 10)"), data)));
  };
  auto good = open(-1, 1);
  ASSERT_TRUE(good) << format_diagnostic(good.error());
  good.value().limit_sources(1);
  const std::vector<Ray> found = read_rays(good.value());
  EXPECT_EQ(found[0].source, 0);
  EXPECT_EQ(found[1].source, no_primitive);
  EXPECT_TRUE(found[0].inside && found[1].inside);
  const auto problem = [&](double source, double inside) {
    auto file = open(source, inside);
    file.value().limit_sources(7);
    std::vector<Ray> rays(2);
    const Status status = file.value().read(rays);
    return status ? std::string() : status.error().key + ": " + status.error().message;
  };
  EXPECT_EQ(problem(6, 0), "");
  EXPECT_EQ(problem(7, 0), "source: row 1: must be -1 or an id below 7, is 7");
  EXPECT_EQ(problem(-2, 0), "source: row 1: must be -1 or an id below 7, is -2");
  EXPECT_EQ(problem(1.5, 0), "source: row 1: must be -1 or an id below 7, is 1.5");
  EXPECT_EQ(problem(std::nan(""), 0), "source: row 1: must be -1 or an id below 7, is nan");
  EXPECT_EQ(problem(1, 0.5), "inside: row 0: must be 0 or 1, is 0.5");
}

TEST_F(TraceFiles, DirectionsThatNoFloatHoldsBecomeInfinite) {
  constexpr double inf = std::numeric_limits<double>::infinity(), huge = 1e300;
  constexpr double nan = std::numeric_limits<double>::quiet_NaN();
  const RayRow good = {1, 2, 3, 0, 0, 0, -1, inf};
  std::vector<RayRow> rows(9, good);
  rows[1][7] = huge;
  rows[2][3] = -huge;
  rows[3][0] = huge;
  rows[4][6] = -huge;  // lost
  rows[5][6] = 1e-60;  // lost: no direction
  rows[6][6] = 0;      // not lost: had no direction
  rows[7][4] = inf;    // not lost: was infinite
  rows[8][1] = nan;
  auto file = RayFile::open(write("r.npy", ray_file64(rows)));
  ASSERT_TRUE(file) << format_diagnostic(file.error());
  const std::vector<Ray> found = read_rays(file.value());
  constexpr float infinite = std::numeric_limits<float>::infinity();
  EXPECT_EQ(found[1].tmax, huge);
  EXPECT_EQ(found[2].tmin, -huge);
  EXPECT_EQ(found[3].org.x, huge);
  EXPECT_EQ(found[4].dir.z, -infinite);
  EXPECT_EQ(found[5].dir, (Vec3f{0, 0, 0}));
  EXPECT_EQ(found[7].dir.x, infinite);
  EXPECT_TRUE(std::isnan(found[8].org.y));
  EXPECT_EQ(file.value().lost(), 2u);
}

TEST_F(TraceFiles, VanishingRaysAreAnError) {
  const std::string name = write("r.npy", ray_file(ray_cloud(100)));
  auto file = RayFile::open(name);
  ASSERT_TRUE(file);
  std::filesystem::resize_file(name, 128 + 99 * 32 + 31);
  std::vector<Ray> rays(100);
  const Status status = file.value().read(rays);
  ASSERT_FALSE(status);
  EXPECT_EQ(format_diagnostic(status.error()), name + ": error: became shorter while it was read");
}

TEST_F(TraceFiles, HitsAreWrittenAsNumpyWrites) {
  const std::vector<TracedHit> hits = {
      {}, {0.1, 2, {0.6f, -0.8f, -0.0f}, true}, {1e300, 0, {1, 0, 0}}};
  auto file = HitFile::create(path("h.npy"), HitKind::closest, hits.size());
  ASSERT_TRUE(file);
  EXPECT_FALSE(std::filesystem::exists(path("h.npy")));
  EXPECT_TRUE(std::filesystem::exists(file.value().temporary()));
  const std::span<const TracedHit> all(hits);
  EXPECT_TRUE(file.value().append(all.first(1)));
  EXPECT_TRUE(file.value().append(all.subspan(1)));
  EXPECT_TRUE(file.value().sync());
  EXPECT_TRUE(file.value().commit());
  const std::string bytes = read("h.npy");
  EXPECT_TRUE(bytes == hit_file(hits));
  EXPECT_EQ(bytes.size(), 192u + 3 * 25);
  EXPECT_EQ(file_count(), 1u);
}

/// Of crossings nobody knows the number before the end.
TEST_F(TraceFiles, CrossingsAreCountedInTheEnd) {
  const Crossings some{{0, 2, 2, 3}, {0.5, 1.5, 2.5}, {7, 7, 3}, {1, 0, 1}};
  const Crossings none{{0, 0}, {}, {}, {}};
  for (const bool syncs : {false, true}) {
    auto file = HitFile::create(path("h.npy"), HitKind::all, 99);
    ASSERT_TRUE(file);
    EXPECT_TRUE(file.value().append(some, 0));
    EXPECT_TRUE(file.value().append(none, 3));
    EXPECT_TRUE(file.value().append(some, 4));
    EXPECT_FALSE(file.value().append(std::vector<double>{1}));
    if (syncs) EXPECT_TRUE(file.value().sync());
    EXPECT_TRUE(file.value().commit());
    std::string data;
    for (const std::int64_t first : {0, 4}) {
      const std::int64_t rays[] = {first, first, first + 2};
      for (std::size_t k = 0; k < 3; ++k) {
        append_bytes(data, rays[k]);
        append_bytes(data, some.t[k]);
        append_bytes(data, some.id[k]);
        append_bytes(data, some.entering[k]);
      }
    }
    const std::string descr = "[('ray', '<i8'), ('t', '<f8'), ('id', '<i4'), ('entering', '|b1')]";
    EXPECT_TRUE(read("h.npy") == npy_file(hit_dict(descr, 6), data));
  }
}

TEST_F(TraceFiles, MetIsWrittenAsBytes) {
  const std::vector<std::uint8_t> met = {1, 0, 0, 1, 1};
  auto file = HitFile::create(path("h.npy"), HitKind::any, met.size());
  ASSERT_TRUE(file);
  EXPECT_TRUE(file.value().append(met));
  EXPECT_TRUE(file.value().commit());
  EXPECT_TRUE(read("h.npy") == met_file(met));
}

TEST_F(TraceFiles, MissingRaysAreAnError) {
  auto file = RayFile::open(write("r.npy", ray_file(ray_cloud(10))));
  ASSERT_TRUE(file);
  std::vector<Ray> rays(7);
  EXPECT_TRUE(file.value().read({}));
  EXPECT_TRUE(file.value().read(rays));
  EXPECT_FALSE(file.value().read(rays));
  RayFile kept = std::move(file).value();
  EXPECT_FALSE(file.value().read(rays));
}

/// A file that was moved from refuses, also what the other one had.
TEST_F(TraceFiles, WhatIsAssignedToAnotherRefuses) {
  const std::vector<Ray> cloud = ray_cloud(10);
  auto one = RayFile::open(write("one.npy", ray_file(cloud)));
  auto two = RayFile::open(write("two.npy", ray_file(cloud)));
  ASSERT_TRUE(one && two);
  std::vector<Ray> rays(3);
  one.value() = std::move(two.value());
  EXPECT_FALSE(two.value().read({}));  // NOLINT: that is the test, here and below
  EXPECT_FALSE(two.value().read(rays));
  EXPECT_TRUE(one.value().read(rays));

  auto first = HitFile::create(path("first.npy"), HitKind::any, 0);
  auto second = HitFile::create(path("second.npy"), HitKind::any, 0);
  ASSERT_TRUE(first && second);
  const auto before = file_count();
  first.value() = std::move(second.value());
  EXPECT_FALSE(second.value().append(std::vector<std::uint8_t>()));
  EXPECT_FALSE(second.value().commit());
  EXPECT_EQ(file_count(), before);
  EXPECT_TRUE(first.value().commit());
  EXPECT_TRUE(std::filesystem::exists(path("second.npy")));
  EXPECT_FALSE(std::filesystem::exists(path("first.npy")));
}

TEST_F(TraceFiles, HitsOfAnotherFileAreAnError) {
  const std::vector<TracedHit> hits(5);
  const std::vector<std::uint8_t> met(5);
  for (const HitKind kind : {HitKind::closest, HitKind::any}) {
    auto file = HitFile::create(path("h.npy"), kind, 8);
    ASSERT_TRUE(file);
    const auto append = [&](std::size_t count) {
      return kind == HitKind::any ? file.value().append(std::span(met).first(count))
                                  : file.value().append(std::span(hits).first(count));
    };
    const std::string start = "cannot write '" + path("h.npy") + "': ";
    EXPECT_EQ(kind == HitKind::any ? file.value().append(hits).error().message
                                   : file.value().append(met).error().message,
              start + "hits of the other kind");
    EXPECT_TRUE(append(5));
    EXPECT_EQ(append(4).error().message, start + "more hits than it is made for");
    EXPECT_EQ(file.value().commit().error().message, start + "3 hits are missing");
    EXPECT_EQ(file_count(), 0U);
    EXPECT_TRUE(append(3));
    HitFile moved = std::move(file).value();
    EXPECT_FALSE(file.value().commit());
    EXPECT_TRUE(moved.commit());
    EXPECT_FALSE(moved.commit());
    EXPECT_EQ(file_count(), 1U);
    std::filesystem::remove(path("h.npy"));
  }
}

TEST_F(TraceFiles, WithoutCommitNothingIsLeft) {
  (void)write("h.npy", "old");
  {
    auto file = HitFile::create(path("h.npy"), HitKind::closest, 5000);
    ASSERT_TRUE(file);
    EXPECT_TRUE(file.value().append(std::vector<TracedHit>(5000)));
    EXPECT_EQ(file_count(), 1u);  // the temporary file has no name yet
  }
  EXPECT_EQ(read("h.npy"), "old");
  EXPECT_EQ(file_count(), 1u);
}

TEST_F(TraceFiles, ANumpyNameEndsWithNpy) {
  for (const char* name : {"a.npy", "b/a.NPY", "a.b.npy"}) EXPECT_TRUE(is_npy_name(name)) << name;
  for (const char* name : {"", "a", "npy", ".npy", "a.npyz", "a.npy/", "a.npy.png", "-"}) {
    EXPECT_FALSE(is_npy_name(name)) << name;
  }
}

}  // namespace
}  // namespace boule::test
