#include "render/apps/cli/options/part_options.h"

#include "render/apps/cli/options/option_kinds.h"
#include "render/apps/job/options/option_values.h"

namespace boule::cli {

std::optional<TimedFile> parse_timed_file(const std::string& text) {
  const std::size_t comma = text.rfind(',');
  TimedFile choice{text};
  if (comma != std::string::npos) {
    const auto interval = parse_duration(text.substr(comma + 1));
    if (!interval) return std::nullopt;
    choice = {text.substr(0, comma), *interval};
  }
  return choice.file.empty() ? std::nullopt : std::optional(choice);
}

std::optional<Shard> parse_shard(const std::string& text) {
  const auto parts = split(text, '/');
  if (parts.size() != 2) return std::nullopt;
  constexpr int most = 1'000'000;
  const auto count = parse_number(parts[1], 1, most);
  const auto index = parse_number(parts[0], 1, count.value_or(1));
  if (!count || !index) return std::nullopt;
  return Shard{*index, *count};
}

void add_part_options(CLI::App& app, RenderCommand& command) {
  start_group(app, "Long runs and many machines");
  add_parsed(app, "--checkpoint", command.checkpoint, parse_timed_file,
             "FILE or FILE,TIME such as run.film,60s", "FILE[,TIME]",
             "Save what is rendered every TIME (60s) and when a signal or limit stops it");
  app.add_flag("--resume", command.resume,
               "Go on from the checkpoint, where there is one; --spp may be greater");
  add_parsed(app, "--preview", command.preview, parse_timed_file,
             "IMAGE or IMAGE,TIME such as now.png,10s", "IMAGE[,TIME]",
             "Write the picture as far as it is every TIME (60s)");
  add_parsed(app, "--shard", command.shard, parse_shard, "K/N with 1 <= K <= N, such as 3/8", "K/N",
             "Render share K of N into a .film file; boule merge makes the picture");
  app.add_flag("--claim", command.claim,
               "Share a series with other processes: each takes frames that nobody has");
  add_choice(app, "--mpi", command.mpi,
             std::array{Named{"auto", MpiUse::automatic}, Named{"never", MpiUse::never}},
             "Whether processes that mpirun or srun started work together (auto)");
}

void add_merge(CLI::App& app, MergeCommand& command) {
  app.add_option("FILMS", command.films, "Film files of all shards of one picture")
      ->required()
      ->type_name("");
  start_group(app, "Output");
  app.add_option("-o,--output", command.output, "Picture to write; its extension names the format")
      ->required()
      ->type_name("IMAGE");
  add_parsed(
      app, "--exposure", command.exposure_stops,
      [](const std::string& text) { return parse_number(text, -100.0F, 100.0F); },
      "a number from -100 to 100", "STOPS", "Brighten 8-bit pictures by 2^STOPS (0)");
  add_choice(app, "--compression", command.compression, choices<Compression>(),
             "Packing of EXR pictures (zip)");
  app.add_flag("-q,--quiet", command.quiet, "Only errors");
  start_group(app, "Machine");
  add_whole(app, "-t,--threads", command.threads, 0U, 1024U, "Threads, 0: all (0)");
}

namespace {

Status check_shard(const RenderCommand& command) {
  if (!command.output.ends_with(".film"))
    return wrong_option("a shard is a .film file, expected such a name", "--output");
  if (command.skip_existing || command.claim)
    return wrong_option("goes with pictures, not with --shard",
                        command.claim ? "--claim" : "--skip-existing");
  return {};
}

}  // namespace

Status check_part_options(const RenderCommand& command) {
  if (command.resume && !command.checkpoint)
    return wrong_option("needs --checkpoint, which names the file", "--resume");
  if (command.checkpoint && command.output == standard_output)
    return wrong_option("needs a picture in a file, not on standard output", "--checkpoint");
  if (command.claim && !command.frames)
    return wrong_option("shares out a series: --frames is missing", "--claim");
  if (command.claim && command.output == standard_output)
    return wrong_option("needs pictures in files, not on standard output", "--claim");
  return command.shard ? check_shard(command) : Status();
}

}  // namespace boule::cli
