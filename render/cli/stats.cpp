#include "render/cli/stats.h"

#include <fmt/format.h>
#include <sys/resource.h>

#include <nlohmann/json.hpp>

#include "render/cli/messages.h"
#include "render/cli/picture_header.h"
#include "render/image/output_file.h"

namespace boule::cli {
namespace {

/// The most memory the process has had.
double peak_rss_mib() {
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  return static_cast<double>(usage.ru_maxrss) / 1024;  // Linux counts in KiB
}

std::string as_text(const Stats& s) {
  const RenderStatistics& r = s.rendering;
  return fmt::format(
      "boule: stats: {} ({}), solver {}, {}, {} x {} pixels, {} spp\n"
      "boule: stats: load {:.3f} s, prepare {:.3f} s, render {:.3f} s, write {:.3f} s, "
      "total {:.3f} s\n"
      "boule: stats: rays: {} primary, {} shadow, {} continuation, {:.1f} Mray/s\n"
      "boule: stats: peak memory {:.1f} MiB",
      r.isa, counted(static_cast<std::size_t>(r.width), "lane"), solver_name(r.solver),
      counted(r.threads, "thread"), s.size.width, s.size.height, s.spp, s.load_seconds,
      r.prepare_seconds, r.render_seconds, s.write_seconds, s.total_seconds, r.rays.primary,
      r.rays.shadow, r.rays.continuation, mrays_per_s(r), peak_rss_mib());
}

std::string as_json(const Stats& s) {
  const RenderStatistics& r = s.rendering;
  const nlohmann::ordered_json json = {{"schema", 1},
                                       {"version", BOULE_VERSION},
                                       {"isa", r.isa},
                                       {"width", r.width},
                                       {"solver", solver_name(r.solver)},
                                       {"threads", r.threads},
                                       {"size", {s.size.width, s.size.height}},
                                       {"spp", s.spp},
                                       {"seconds",
                                        {{"load", s.load_seconds},
                                         {"prepare", r.prepare_seconds},
                                         {"render", r.render_seconds},
                                         {"write", s.write_seconds},
                                         {"total", s.total_seconds}}},
                                       {"rays",
                                        {{"primary", r.rays.primary},
                                         {"shadow", r.rays.shadow},
                                         {"continuation", r.rays.continuation}}},
                                       {"mrays_per_s", mrays_per_s(r)},
                                       {"peak_rss_mib", peak_rss_mib()}};
  return json.dump(2) + "\n";
}

Status write_file(const std::string& text, const std::string& path) {
  auto file = OutputFile::create(path);
  if (!file) return file.error();
  if (auto bad = file.value().write(text.data(), text.size())) return bad;
  return file.value().commit();
}

}  // namespace

double mrays_per_s(const RenderStatistics& statistics) {
  const double seconds = statistics.render_seconds;
  return seconds > 0 ? static_cast<double>(statistics.rays.total()) / seconds * 1e-6 : 0;
}

Status write_stats(const Stats& stats, const StatsTarget& target) {
  switch (target.form) {
    case StatsForm::none:
      return std::nullopt;
    case StatsForm::text:
      print_note(as_text(stats));
      return std::nullopt;
    case StatsForm::json:
      break;
  }
  if (target.file == "-") return print_data(as_json(stats));
  return write_file(as_json(stats), target.file);
}

}  // namespace boule::cli
