// The experiment with remedies against false shadows finds false shadows and leaks.
#include "bench/errors/epsilons.h"

#include <gtest/gtest.h>

namespace boule::bench {
namespace {

constexpr std::size_t points = 500;
constexpr std::uint64_t seed = 7;

std::vector<EpsilonFigure> all_figures() {
  static const auto figures = run_epsilon_experiment(points, seed);
  return figures;
}

void expect_sound(const EpsilonFigure& f) {
  EXPECT_EQ(f.points, points);
  EXPECT_LT(f.undecided * 50, f.points);
  EXPECT_EQ(f.wrong_hits, 0U);
  EXPECT_GT(f.lit, points / 5);
  EXPECT_LT(f.lit, points * 19 / 20);  // there are shadows to leak into
}

TEST(Epsilons, OursIsNeverWrong) {
  for (const EpsilonFigure& f : all_figures()) {
    SCOPED_TRACE(f.experiment + " " + std::to_string(f.x));
    expect_sound(f);
    if (f.remedy != "ours") continue;
    EXPECT_EQ(f.false_shadows, 0U);
    EXPECT_EQ(f.leaks, 0U);
  }
}

TEST(Epsilons, EveryOtherRemedyIsWrongSomewhere) {
  for (const std::string& remedy : epsilon_remedies()) {
    std::size_t wrong = 0;
    for (const EpsilonFigure& f : all_figures())
      wrong += f.remedy == remedy ? f.false_shadows + f.leaks : 0;
    EXPECT_EQ(wrong == 0, remedy == "ours") << remedy;
  }
}

TEST(Epsilons, TheLecturesIsWrongAtEveryScaleFromOrdinaryUp) {
  for (const EpsilonFigure& f : all_figures()) {
    if (f.experiment != "scale" || f.x < 0.5) continue;
    if (f.remedy == "none" || f.remedy == "t > 1e-6") {
      EXPECT_GT(f.false_shadows, points / 50) << f.remedy << " " << f.x;
    }
  }
}

TEST(Epsilons, TheSameSeedGivesTheSameFigures) {
  const EpsilonScene scene = scene_of_scale(1);
  const auto once = epsilon_figures(scene, points, seed),
             again = epsilon_figures(scene, points, seed);
  ASSERT_EQ(once.size(), epsilon_remedies().size());
  for (std::size_t k = 0; k < once.size(); ++k) {
    EXPECT_EQ(once[k].false_shadows, again[k].false_shadows);
    EXPECT_EQ(once[k].leaks, again[k].leaks);
    EXPECT_EQ(once[k].lit, again[k].lit);
  }
}

TEST(Epsilons, PicturesMarkWhatTheyCount) {
  for (const EpsilonPicture& picture : draw_epsilon_pictures(scene_of_scale(1), 64, 48)) {
    std::size_t marked = 0;
    for (std::size_t i = 0; i < picture.plain.pixels.size(); ++i)
      marked += picture.plain.pixels[i] == picture.marked.pixels[i] ? 0 : 1;
    EXPECT_EQ(marked, picture.false_shadows + picture.leaks) << picture.remedy;
  }
}

}  // namespace
}  // namespace boule::bench
