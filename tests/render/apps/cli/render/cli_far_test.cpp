// One scene in every form that there is, moved by 10^4 to 10^9: it has the hits and the picture
// that it has at 0, to the byte.
#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "tests/render/apps/cli/trace/trace_program.h"
#include "tests/support/case_random.h"

namespace boule::test {
namespace {

using testing::HasSubstr;
using testing::Not;

struct Ball {
  Vec3d center;
  double radius;
};

/// A multiple of 2^-10: exact in double out there, too.
double on_grid(double x) { return std::nearbyint(x * 1024) / 1024; }
Vec3d on_grid(const Vec3d& v) { return {on_grid(v.x), on_grid(v.y), on_grid(v.z)}; }

/// Forty balls about 0, but not around it.
std::vector<Ball> balls() {
  CaseRandom random(55);
  std::vector<Ball> all;
  for (int i = 0; i < 40; ++i) {
    const Vec3d way = random.direction() * random.uniform(0, 3);
    const double radius = on_grid(random.uniform(0.1, 0.4));
    all.push_back({on_grid(way + Vec3d{0.5, 0.75, -0.25}), radius});
  }
  return all;
}

std::string words(const Vec3d& v) {
  return text_of(v.x) + " " + text_of(v.y) + " " + text_of(v.z) + " ";
}
std::string point(const Vec3d& v) {
  return "[" + text_of(v.x) + ", " + text_of(v.y) + ", " + text_of(v.z) + "]\n";
}

class Far : public Trace, public testing::WithParamInterface<std::string> {
 protected:
  std::string write_balls(const std::string& name, const Vec3d& moved) const {
    std::string rows;
    for (const Ball& ball : balls_) {
      const Vec3d at = ball.center + moved;
      for (const double x : {at.x, at.y, at.z, ball.radius}) append_bytes(rows, x);
    }
    return write(name, npy_file(npy_dict("'<f8'", "(40, 4)"), rows));
  }
  /// The tables of the balls, under this header.
  std::string tables(const std::string& header, const Vec3d& moved) const {
    std::string text;
    for (const Ball& ball : balls_) {
      text += header + "\ncenter = " + point(ball.center + moved) +
              "radius = " + text_of(ball.radius) + "\n";
    }
    return text;
  }
  /// A scene of these objects with a floor, a light and a camera.
  std::string scene(const std::string& objects, const Vec3d& moved) const {
    return write("scene.toml", "schema = 1\n" + objects +
                                   "[[plane]]\npoint = " + point(moved + Vec3d{0, -3.5, 0}) +
                                   "[[light]]\nposition = " + point(moved + Vec3d{5, 9, 7}) +
                                   "[camera]\neye = " + point(moved + Vec3d{1.25, 2.5, 9}) +
                                   "look_at = " + point(moved + Vec3d{0, 0.125, 0}));
  }
  std::string nff(const Vec3d& moved) const {
    std::string text = "v\nfrom " + words(moved + Vec3d{1.25, 2.5, 9}) + "\nat " + words(moved) +
                       "\nup 0 1 0\nangle 40\nhither 1\nresolution 64 48\nl " +
                       words(moved + Vec3d{5, 9, 7}) + "\nf 0.8 0.5 0.3 1 0 1 0 1\np 3\n";
    for (const Vec3d& corner : {Vec3d{0, -3.5, 0}, Vec3d{0, -3.5, 1}, Vec3d{1, -3.5, 0}})
      text += words(corner + moved) + "\n";
    for (const Ball& ball : balls_)
      text += "s " + words(ball.center + moved) + text_of(ball.radius) + "\n";
    return write("scene.nff", text);
  }
  std::string particles(const Vec3d& moved) const {
    std::string text = "40\nProperties=species:S:1:pos:R:3:radius:R:1\n";
    for (const Ball& ball : balls_)
      text += "C " + words(ball.center + moved) + text_of(ball.radius) + "\n";
    return write("balls.xyz", text);
  }
  std::string packed(const std::string& input) const {
    const ProgramRun run = boule_run({"pack", input, "-o", path("scene.boule"), "-q"});
    EXPECT_EQ(run.exit_code, 0) << run.err;
    return path("scene.boule");
  }

  /// Writes the scene of a form, moved. Returns the name of its file.
  std::string make(const std::string& form, const Vec3d& moved) const {
    if (form == "sphere") return scene(tables("[[sphere]]", moved), moved);
    if (form == "spheres") {
      write_balls("balls.npy", moved);
      return scene("[[spheres]]\nfile = \"balls.npy\"\n", moved);
    }
    if (form == "particles") {
      particles(moved);
      return scene("[[particles]]\nfile = \"balls.xyz\"\n", moved);
    }
    if (form == "instance") {
      return scene(tables("[[group.all.sphere]]", {}) +
                       "[[instance]]\ngroup = \"all\"\ntranslate = " + point(moved),
                   moved);
    }
    if (form == "group") {  // far inside, and moved back half of the way
      return scene(tables("[[group.all.sphere]]", moved * 1.5) +
                       "[[group.pair.instance]]\ngroup = \"all\"\nrotate = [0, 0, 180]\n"
                       "[[instance]]\ngroup = \"pair\"\nrotate = [0, 0, 180]\ntranslate = " +
                       point(moved * -0.5),
                   moved);
    }
    if (form == "nff") return nff(moved);
    if (form == "npy") return write_balls("balls.npy", moved);
    if (form == "xyz") return particles(moved);
    if (form == "fitted") {
      return write("scene.toml", "schema = 1\n" + tables("[[sphere]]", moved));
    }
    if (form == "packed_npy") return packed(write_balls("balls.npy", moved));
    if (form == "packed") return packed(scene(tables("[[sphere]]", moved), moved));
    ADD_FAILURE() << form;
    return "";
  }

  std::string picture(const std::string& scene) const {
    const ProgramRun run =
        boule_run({"render", scene, "-o", path("p.png"), "--size=64x48", "--spp=2", "-q"});
    EXPECT_EQ(run.exit_code, 0) << run.err;
    return read("p.png");
  }
  /// Rays at all balls from all around.
  std::string hits_of(const std::string& scene, const Vec3d& moved) const {
    CaseRandom random(5);
    std::vector<RayRow> rows;
    for (int round = 0; round < 10; ++round) {
      for (const Ball& ball : balls_) {
        const Vec3d from = on_grid(random.direction() * 9.0);
        const Vec3d to = ball.center + random.direction() * (ball.radius * 0.99) - from;
        const Vec3d org = from + moved;
        rows.push_back({org.x, org.y, org.z, 0, to.x, to.y, to.z, 1e9});
      }
    }
    write("r.npy", ray_file64(rows));
    return hits(scene);
  }

  const std::vector<Ball> balls_ = balls();
};

TEST_P(Far, HitsAndPictureMatchThoseAtZero) {
  const std::string near = make(GetParam(), {});
  const std::string near_picture = picture(near), near_hits = hits_of(near, {});
  for (int power = 4; power <= 9; ++power) {
    const double unit = std::nearbyint(std::pow(10, power));
    const Vec3d moved{unit, unit * -2, unit * 0.5};
    const std::string far = make(GetParam(), moved);
    EXPECT_TRUE(hits_of(far, moved) == near_hits) << "10^" << power;
    EXPECT_TRUE(picture(far) == near_picture) << "10^" << power;
  }
}

INSTANTIATE_TEST_SUITE_P(Forms, Far,
                         testing::Values("sphere", "spheres", "particles", "instance", "group",
                                         "nff", "npy", "xyz", "fitted", "packed_npy", "packed"),
                         [](const auto& form) { return form.param; });

using FarNotes = Far;

TEST_F(FarNotes, TellTheOriginOnce) {
  const Vec3d moved{1000000, -2000000, 500000};
  for (const char* form : {"npy", "nff", "instance"}) {
    const std::string scene = make(form, moved);
    const ProgramRun run =
        boule_run({"render", scene, "-o", path("p.png"), "--size=16x12", "--spp=1"});
    const std::string note = "boule: note: points are counted from [1000000, -2000000, 500000]";
    EXPECT_THAT(run.err, HasSubstr(note)) << form;
    EXPECT_THAT(run.err.substr(run.err.find(note) + note.size()), Not(HasSubstr("counted from")));
    EXPECT_THAT(boule_run({"pack", scene, "-o", path("s.boule")}).err, HasSubstr(note)) << form;
    EXPECT_THAT(boule_run({"render", make(form, {}), "-o", path("p.png"), "--size=16x12"}).err,
                Not(HasSubstr("counted from")));
  }
}

/// Two balls that no origin brings together.
TEST_F(FarNotes, TellWhatNoOriginHelps) {
  const std::string apart =
      write("apart.toml",
            "schema = 1\n[[sphere]]\ncenter = [0.3, 0, 0]\n[[sphere]]\ncenter = [1e7, 0.3, 0]\n"
            "[[sphere]]\ncenter = [10000000.3, 5, 0]\nradius = 2\n");
  const ProgramRun run =
      boule_run({"render", apart, "-o", path("p.png"), "--size=16x12", "--spp=1"});
  EXPECT_EQ(run.exit_code, 0);
  EXPECT_THAT(run.err, HasSubstr("boule: note: positions are rounded by up to 0.3 radii of the "
                                 "smallest sphere: the spheres reach too far for 32-bit floats"));
}

TEST_F(FarNotes, InfoTellsThePointsOfTheFile) {
  const Vec3d moved{1000000, -2000000, 500000};
  const ProgramRun run = boule_run({"info", make("group", moved), "--json"});
  EXPECT_EQ(run.exit_code, 0) << run.err;
  std::string told = run.out;
  told.erase(std::remove_if(told.begin(), told.end(), [](char c) { return c == ' ' || c == '\n'; }),
             told.end());
  EXPECT_THAT(told, HasSubstr("\"group\":\"pair\",\"translate\":[-500000.0,1000000.0,-250000.0]"));
  EXPECT_THAT(told, HasSubstr("\"group\":\"all\",\"translate\":[0.0,0.0,0.0]"));
  EXPECT_THAT(told, HasSubstr("\"center\":[1500000.18164062,-2999997.7929688,750000.09277344]"));
  EXPECT_THAT(told, HasSubstr("\"center\":[1000000.18164062,-1999997.7929688,500000.09277344]"));
}

}  // namespace
}  // namespace boule::test
