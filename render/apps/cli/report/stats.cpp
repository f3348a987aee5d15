#include "render/apps/cli/report/stats.h"

#include <fmt/format.h>
#include <sys/resource.h>

#include <nlohmann/json.hpp>

#include "core/base/version.h"
#include "render/apps/cli/process/interrupt.h"
#include "render/apps/cli/process/messages.h"
#include "render/apps/cli/process/text_output.h"

namespace boule::cli {
namespace {

using Json = nlohmann::ordered_json;

/// The most memory the process has had.
double peak_rss_mib() {
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  return static_cast<double>(usage.ru_maxrss) / 1024;  // Linux counts in KiB
}

const char* work_name(const Stats& s) { return s.picture ? "render" : "trace"; }

std::string picture_text(const PictureStats& picture) {
  return fmt::format(", {} x {} pixels, {} spp", picture.size.width, picture.size.height,
                     picture.spp);
}

double millions_per_s(std::uint64_t count, const Stats& stats) {
  const double seconds = stats.work_seconds;
  return seconds > 0 ? static_cast<double>(count) / seconds * 1e-6 : 0;
}

std::string noise_text(const Stats& s) {
  if (!s.picture || !s.picture->noise) return {};
  const NoiseReached& noise = *s.picture->noise;
  if (s.picture->aa > 0) {
    return fmt::format(
        "boule: stats: aa: {}, {:.2f} samples a pixel, {:.2f} % of the pixels with fewer than {}\n",
        s.picture->aa, noise.mean_samples, noise.share * 100, s.picture->spp);
  }
  return fmt::format(
      "boule: stats: noise: {} asked for, {:.4f} reached in 95 % of the pixels, {:.1f} samples a "
      "pixel, {:.2f} % of the pixels settled\n",
      s.picture->noise_target, noise.half_width, noise.mean_samples, noise.share * 100);
}

std::string rays_text(const Stats& s) {
  if (!s.picture) return std::to_string(s.rays);
  const RayCounts& rays = s.picture->rays;
  return fmt::format("{} primary, {} shadow, {} continuation", rays.primary, rays.shadow,
                     rays.continuation);
}

std::string work_text(const Stats& s) {
  if (s.points > 0)
    return fmt::format("boule: stats: points: {}, {:.1f} Mpoint/s\n", s.points, mpoints_per_s(s));
  return fmt::format("boule: stats: rays: {}, {:.1f} Mray/s\n", rays_text(s), mrays_per_s(s));
}

std::string faults_text(const Stats& s) {
  if (!s.picture) return {};
  const SampleFaults& faults = s.picture->faults;
  return fmt::format("boule: stats: samples: {} not finite, {} too bright\n", faults.not_finite,
                     faults.too_bright);
}

std::string as_text(const Stats& s) {
  return fmt::format(
      "boule: stats: {} ({}), solver {}, {}{}\n"
      "boule: stats: load {:.3f} s, prepare {:.3f} s, {} {:.3f} s, write {:.3f} s, "
      "total {:.3f} s\n"
      "{}{}{}"
      "boule: stats: peak memory {:.1f} MiB",
      s.isa, counted(static_cast<std::size_t>(s.width), "lane"), name_of(s.solver),
      counted(s.threads, "thread"), s.picture ? picture_text(*s.picture) : "", s.load_seconds,
      s.prepare_seconds, work_name(s), s.work_seconds, s.write_seconds, s.total_seconds,
      work_text(s), faults_text(s), noise_text(s), peak_rss_mib());
}

Json rays_json(const Stats& s) {
  if (!s.picture) return {{"count", s.rays}};
  const RayCounts& rays = s.picture->rays;
  return {{"primary", rays.primary}, {"shadow", rays.shadow}, {"continuation", rays.continuation}};
}

std::string as_json(const Stats& s) {
  Json json = {{"schema", 1},      {"version", library_version()}, {"isa", s.isa},
               {"width", s.width}, {"solver", name_of(s.solver)},  {"threads", s.threads}};
  if (s.picture) {
    json["size"] = {s.picture->size.width, s.picture->size.height};
    json["spp"] = s.picture->spp;
  }
  json["seconds"] = {{"load", s.load_seconds},
                     {"prepare", s.prepare_seconds},
                     {work_name(s), s.work_seconds},
                     {"write", s.write_seconds},
                     {"total", s.total_seconds}};
  json["rays"] = rays_json(s);
  if (s.points > 0) json["points"] = {{"count", s.points}};
  if (s.picture) {
    json["samples_not_finite"] = s.picture->faults.not_finite;
    json["samples_too_bright"] = s.picture->faults.too_bright;
    if (s.picture->noise) {
      const NoiseReached& noise = *s.picture->noise;
      json[s.picture->aa > 0 ? "aa" : "noise"] = {
          {"target", s.picture->aa > 0 ? s.picture->aa : s.picture->noise_target},
          {"reached", noise.half_width},
          {"mean_spp", noise.mean_samples},
          {"settled", noise.share}};
    }
  }
  json["mrays_per_s"] = mrays_per_s(s);
  if (s.points > 0) json["mpoints_per_s"] = mpoints_per_s(s);
  json["peak_rss_mib"] = peak_rss_mib();
  return json.dump(2) + "\n";
}

}  // namespace

double mrays_per_s(const Stats& stats) { return millions_per_s(stats.rays, stats); }
double mpoints_per_s(const Stats& stats) { return millions_per_s(stats.points, stats); }

std::string samples_text(const PictureStats& picture) {
  if (!picture.noise) return fmt::format("{} spp", picture.spp);
  return fmt::format("{:.1f} spp on average, noise {:.3g}", picture.noise->mean_samples,
                     picture.noise->half_width);
}

std::vector<std::string> fault_notes(const SampleFaults& faults) {
  std::vector<std::string> notes;
  const auto tell = [&notes](std::uint64_t samples, const char* fault) {
    if (samples > 0) notes.push_back("boule: note: " + counted(samples, "sample") + fault);
  };
  tell(faults.not_finite, " not finite, shown as black");
  tell(faults.too_bright, " too bright for a float32, shown as the largest");
  return notes;
}

Status write_stats(const Stats& stats, const StatsTarget& target) {
  switch (target.form) {
    case StatsForm::none:
      return {};
    case StatsForm::text:
      print_note(as_text(stats));
      return {};
    case StatsForm::json:
      break;
  }
  if (target.file == "-") return print_data(as_json(stats));
  return write_text_file(as_json(stats), target.file);
}

}  // namespace boule::cli
