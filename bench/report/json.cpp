#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "bench/report/figures.h"
#include "render/image/encode_image.h"

namespace boule::bench {

using Json = nlohmann::json;

// Members under their own names.
NLOHMANN_DEFINE_TYPE_NON_INTRUSIVE(ReportSettings, quick, seed)
NLOHMANN_DEFINE_TYPE_NON_INTRUSIVE(Provenance, cpu, cores, compiler, flags, commit, date, command)
NLOHMANN_DEFINE_TYPE_NON_INTRUSIVE(SolverSpeed, scene, structure, isa, solver, mrays_per_s, least,
                                   most, rays, differ)
NLOHMANN_DEFINE_TYPE_NON_INTRUSIVE(EpsilonFigure, experiment, remedy, x, points, false_shadows,
                                   leaks)
NLOHMANN_DEFINE_TYPE_NON_INTRUSIVE(Growth, spheres, rays, isa, form, ns, least, most)
NLOHMANN_DEFINE_TYPE_NON_INTRUSIVE(PathError, samples, seconds, error)
NLOHMANN_DEFINE_TYPE_NON_INTRUSIVE(NoiseError, asked, mean_samples, seconds, mrays, rms, within_95,
                                   within_99)
NLOHMANN_DEFINE_TYPE_NON_INTRUSIVE(PeerRow, scene, rays, contender, solver, mrays_per_s, least,
                                   most, ratio, count, mismatches, one_solve)
NLOHMANN_DEFINE_TYPE_NON_INTRUSIVE(PeerRows, embree, rows)

namespace {

/// Three columns: decisions and roots, ulp of t, distance from the surface.
Json errors_of(test::HardFigures f) {
  return {{"pairs", f.pairs},
          {"hits", f.hits},
          {"wrong_decisions", f.wrong_decisions},
          {"wrong_roots", f.wrong_roots},
          {"ulp_p50", f.ulp_quantile(0.5)},
          {"ulp_p99", f.ulp_quantile(0.99)},
          {"ulp_max", f.ulp_quantile(1)},
          {"residual_u", f.max_residual}};
}

}  // namespace

static void to_json(Json& json, const CaseErrors& c) {
  json = errors_of(c.errors.figures);
  json.update({{"case", c.hard_case}, {"isa", c.isa}, {"solver", c.errors.contender}});
}

static void to_json(Json& json, const ErrorMap::Cell& cell) {
  json = errors_of(cell.figures);
  json.update({{"solver", cell.contender}, {"distance", cell.distance}, {"grazing", cell.grazing}});
}

static void to_json(Json& json, const EpsilonPicture& p) {
  const std::string bytes = encode_image(p.marked, StreamFormat::png, p.remedy).value();
  std::string png;
  for (const char byte : bytes) png += fmt::format("{:02x}", static_cast<unsigned char>(byte));
  json = {{"remedy", p.remedy},        {"width", p.marked.width},
          {"height", p.marked.height}, {"false_shadows", p.false_shadows},
          {"leaks", p.leaks},          {"png", png}};
}

static void to_json(Json& json, const ScenePathErrors& s) {
  json = {{"scene", s.scene}, {"sequence", s.errors.sequence}, {"random", s.errors.random}};
}

/// Of pictures to order also how long others take until 99 % of their pixels are as good.
static void to_json(Json& json, const SceneNoiseErrors& s) {
  json = {{"scene", s.scene},
          {"uniform", s.errors.uniform},
          {"random", s.errors.random},
          {"to_order", s.errors.to_order}};
  for (Json& row : json["to_order"]) {
    row["uniform_seconds"] = seconds_until(row["within_99"], s.errors.uniform);
    row["random_seconds"] = seconds_until(row["within_99"], s.errors.random);
  }
}

std::string to_json(const Figures& figures) {
  const Json report = {{"provenance", figures.provenance},
                       {"settings", figures.settings},
                       {"speeds", figures.speeds},
                       {"cases", figures.cases},
                       {"capsules", figures.capsules},
                       {"widest", figures.widest},
                       {"map", figures.map.cells},
                       {"epsilons", figures.epsilons},
                       {"pictures", figures.pictures},
                       {"growth", figures.growth},
                       {"path_size", {PathPicture::width, PathPicture::height}},
                       {"paths", figures.paths},
                       {"noise", figures.noise},
                       {"peers", figures.peers ? Json(*figures.peers) : Json()}};
  return report.dump(2) + "\n";
}

}  // namespace boule::bench
