#include "bench/errors/epsilons.h"

#include <utility>

#include "bench/errors/lit_scene.h"
#include "tests/support/case_random.h"

namespace boule::bench {
namespace {

using test::Lit;

/// Whether each remedy finds each point lit: indexed by remedy, then by point.
std::vector<std::vector<std::uint8_t>> all_answers(const LitScene& scene,
                                                   const std::vector<SeenPoint>& points) {
  std::vector<std::vector<std::uint8_t>> lit;
  for (const FloatRemedy& remedy : float_remedies()) lit.push_back(scene.lit(points, remedy));
  lit.push_back(scene.lit(points));
  return lit;
}

/// The points with their true answers, and counts of the points that were left out.
struct Sample {
  std::vector<SeenPoint> points;
  std::size_t undecided = 0, wrong_hits = 0;

  void add(const SeenPoint& point) {
    if (point.decided()) {
      points.push_back(point);
    } else if (!point.right_hit) {
      ++wrong_hits;
    } else if (point.hit) {
      ++undecided;
    }
  }
};

Sample take_sample(const LitScene& lit_scene, const ImageSettings& image, std::size_t count,
                   std::uint64_t seed) {
  constexpr int most_tries = 64;
  test::CaseRandom random(seed);
  Sample sample;
  for (int k = 0; k < most_tries && sample.points.size() < count; ++k) {
    std::vector<std::pair<double, double>> raster;
    for (std::size_t i = 0; i < count; ++i) {
      const double x = random.uniform(0, image.width);
      const double y = random.uniform(0, image.height);
      raster.emplace_back(x, y);
    }
    for (const SeenPoint& point : lit_scene.see(raster, image.width, image.height)) {
      if (sample.points.size() < count) sample.add(point);
    }
  }
  return sample;
}

bool is_false_shadow(const SeenPoint& point, std::uint8_t lit) {
  return point.decided() && point.truth == Lit::yes && lit == 0;
}
bool is_leak(const SeenPoint& point, std::uint8_t lit) {
  return point.decided() && point.truth == Lit::no && lit != 0;
}

std::vector<std::pair<double, double>> pixel_centers(int width, int height) {
  std::vector<std::pair<double, double>> raster;
  for (int y = 0; y < height; ++y) {
    for (int x = 0; x < width; ++x) raster.emplace_back(x + 0.5, y + 0.5);
  }
  return raster;
}

Color shade(const SeenPoint& point, std::uint8_t lit) {
  constexpr float sky = 0.3f, ambient = 0.03f, diffuse = 0.65f;
  if (!point.hit) return gray(sky);
  return gray(ambient + (lit != 0 ? diffuse * static_cast<float>(point.cosine) : 0));
}

EpsilonPicture draw(const std::string& remedy, const std::vector<SeenPoint>& points,
                    const std::vector<std::uint8_t>& lit, const ImageSettings& size) {
  constexpr Color red{0.9f, 0.01f, 0.01f}, blue{0.02f, 0.15f, 1};
  EpsilonPicture picture{remedy, {size.width, size.height}, {size.width, size.height}};
  for (std::size_t i = 0; i < points.size(); ++i) {
    const bool shadow = is_false_shadow(points[i], lit[i]), leak = is_leak(points[i], lit[i]);
    picture.false_shadows += shadow ? 1 : 0;
    picture.leaks += leak ? 1 : 0;
    picture.plain.pixels[i] = shade(points[i], lit[i]);
    picture.marked.pixels[i] = shadow ? red : leak ? blue : picture.plain.pixels[i];
  }
  return picture;
}

}  // namespace

std::vector<std::string> epsilon_remedies() {
  std::vector<std::string> names;
  for (const FloatRemedy& remedy : float_remedies()) names.emplace_back(remedy.name);
  names.emplace_back("ours");
  return names;
}

std::vector<EpsilonFigure> epsilon_figures(const EpsilonScene& scene, std::size_t points,
                                           std::uint64_t seed) {
  const LitScene lit_scene(scene.scene);
  const Sample sample = take_sample(lit_scene, scene.scene.image, points, seed);
  const auto answers = all_answers(lit_scene, sample.points);
  const auto names = epsilon_remedies();
  std::vector<EpsilonFigure> figures;
  for (std::size_t k = 0; k < names.size(); ++k) {
    EpsilonFigure figure{scene.experiment,     names[k],         scene.x,
                         sample.points.size(), sample.undecided, sample.wrong_hits};
    for (std::size_t i = 0; i < sample.points.size(); ++i) {
      figure.lit += sample.points[i].truth == Lit::yes ? 1 : 0;
      figure.false_shadows += is_false_shadow(sample.points[i], answers[k][i]) ? 1 : 0;
      figure.leaks += is_leak(sample.points[i], answers[k][i]) ? 1 : 0;
    }
    figures.push_back(figure);
  }
  return figures;
}

std::vector<EpsilonFigure> run_epsilon_experiment(std::size_t points_per_figure,
                                                  std::uint64_t seed) {
  std::vector<EpsilonFigure> all;
  for (const EpsilonScene& scene : epsilon_scenes()) {
    for (const EpsilonFigure& figure : epsilon_figures(scene, points_per_figure, seed))
      all.push_back(figure);
  }
  return all;
}

std::vector<EpsilonPicture> draw_epsilon_pictures(const EpsilonScene& scene, int width,
                                                  int height) {
  const LitScene lit_scene(scene.scene);
  const auto points = lit_scene.see(pixel_centers(width, height), width, height);
  const auto answers = all_answers(lit_scene, points);
  const auto names = epsilon_remedies();
  std::vector<EpsilonPicture> pictures;
  for (std::size_t k = 0; k < names.size(); ++k)
    pictures.push_back(draw(names[k], points, answers[k], {width, height}));
  return pictures;
}

}  // namespace boule::bench
