// A chain of atoms, as proteins are, a million units from 0: with an origin it has the picture and
// the hits that it has at 0, to the byte; rounded out there it has others.
#include <cmath>
#include <string>
#include <vector>

#include "tests/render/apps/cli/trace/trace_program.h"
#include "tests/support/case_random.h"

namespace boule::test {
namespace {

using testing::HasSubstr;

constexpr Vec3d moved{1000000, -2000000, 500000};

/// A multiple of 2^-13, about a ten-thousandth: exact in double out there, too.
double on_fine_grid(double x) { return std::nearbyint(x * 8192) / 8192; }

/// 400 atoms, each 1.5 from the one before, inside a ball.
std::vector<Vec3d> chain() {
  CaseRandom random(2611);
  std::vector<Vec3d> atoms{{0, 0, 0}};
  while (atoms.size() < 400) {
    const Vec3d next = atoms.back() + random.direction() * 1.5;
    if (dot(next, next) > 144) continue;
    atoms.push_back({on_fine_grid(next.x), on_fine_grid(next.y), on_fine_grid(next.z)});
  }
  return atoms;
}

class Origin : public Trace {
 protected:
  const std::vector<Vec3d> atoms_ = chain();

  /// A scene of the chain around `center`, with a floor, a light and a camera, and with these keys.
  std::string scene(const std::string& name, const Vec3d& center, const std::string& keys) const {
    std::string xyz = std::to_string(atoms_.size()) + "\n\n";
    for (const Vec3d& atom : atoms_) {
      const Vec3d at = atom + center;
      xyz += "C " + text_of(at.x) + " " + text_of(at.y) + " " + text_of(at.z) + "\n";
    }
    write(name + ".xyz", xyz);
    const auto point = [&](double x, double y, double z) {
      return "[" + text_of(x + center.x) + ", " + text_of(y + center.y) + ", " +
             text_of(z + center.z) + "]\n";
    };
    return write(name + ".toml", "schema = 1\n" + keys + "[[particles]]\nfile = \"" + name +
                                     ".xyz\"\n[[plane]]\npoint = " + point(0, -14.5, 0) +
                                     "[[light]]\nposition = " + point(20, 40, 30) +
                                     "[camera]\neye = " + point(3.25, 5.5, 40.125) +
                                     "look_at = " + point(0, 0.125, 0));
  }
  std::string picture(const std::string& scene) const {
    const ProgramRun run =
        boule_run({"render", scene, "-o", path("p.png"), "--size=128x96", "--spp=4", "-q"});
    EXPECT_EQ(run.exit_code, 0) << run.err;
    return read("p.png");
  }
  /// Rays at the atoms from all around, from points that lie around `center`.
  std::string hits_around(const std::string& scene, const Vec3d& center) const {
    CaseRandom random(5);
    std::vector<RayRow> rows;
    for (const Vec3d& atom : atoms_) {
      const Vec3d from = random.direction() * 50.0, to = atom - from;
      const Vec3d org =
          Vec3d{on_fine_grid(from.x), on_fine_grid(from.y), on_fine_grid(from.z)} + center;
      rows.push_back({org.x, org.y, org.z, 0, to.x, to.y, to.z, 1e9});
    }
    write("r.npy", ray_file64(rows));
    return hits(scene);
  }
};

TEST_F(Origin, FarPictureMatchesTheOneAtZero) {
  const std::string near = picture(scene("near", {}, ""));
  EXPECT_TRUE(picture(scene("far", moved, "origin = [1000000, -2000000, 500000]\n")) == near);
  EXPECT_FALSE(picture(scene("rounded", moved, "origin = [0, 0, 0]\n")) == near);
}

TEST_F(Origin, FarHitsMatchThoseAtZero) {
  const std::string near = hits_around(scene("near", {}, ""), {});
  const std::string far = scene("far", moved, "origin = [1000000, -2000000, 500000]\n");
  EXPECT_TRUE(hits_around(far, moved) == near);
  const std::string rounded = scene("rounded", moved, "origin = [0, 0, 0]\n");
  EXPECT_FALSE(hits_around(rounded, moved) == near);
}

TEST_F(Origin, IsFoundAndToldWithoutAKey) {
  const std::string far = scene("far", moved, "");
  const ProgramRun run =
      boule_run({"render", far, "-o", path("p.png"), "--size=128x96", "--spp=4"});
  EXPECT_EQ(run.exit_code, 0) << run.err;
  EXPECT_THAT(run.err, HasSubstr("boule: note: points are counted from [100"));
  // The same point by hand has the same picture.
  const std::size_t begin = run.err.find('[', run.err.find("counted from"));
  const std::string point = run.err.substr(begin, run.err.find(']', begin) - begin + 1);
  EXPECT_TRUE(picture(scene("by_hand", moved, "origin = " + point + "\n")) == read("p.png"));
  EXPECT_TRUE(picture(far) == read("p.png"));
  // Nothing is told at 0.
  const ProgramRun near =
      boule_run({"render", scene("near", {}, ""), "-o", path("p.png"), "--size=16x16"});
  EXPECT_THAT(near.err, testing::Not(HasSubstr("counted from")));
}

}  // namespace
}  // namespace boule::test
