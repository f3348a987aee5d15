#include "render/apps/cli/render/checkpoint.h"

#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <filesystem>
#include <system_error>
#include <utility>

#include "render/apps/cli/process/interrupt.h"
#include "render/apps/cli/process/messages.h"
#include "render/apps/cli/report/run_report.h"

namespace boule::cli {

Result<Checkpoint> Checkpoint::open(const RenderCommand& command, ExitCode& code) {
  const TimedFile& choice = *command.checkpoint;
  code = failed;
  if (auto done = film_file::check_support(); !done) return done.error();
  auto lock = FileLock::take(choice.file + ".lock");
  if (!lock) return lock.error();
  std::error_code ignored;
  if (!command.resume && std::filesystem::exists(choice.file, ignored)) {
    code = wrong_usage;
    return wrong_option(
        quote(choice.file) + " is there already: --resume goes on from it, or remove it first",
        "--checkpoint");
  }
  return Checkpoint(choice, command.resume, std::move(lock).value());
}

Result<bool> Checkpoint::load(const FilmHead& head, PartSheet& sheet) const {
  std::error_code ignored;
  if (!resume_ || !std::filesystem::exists(choice_.file, ignored)) return false;
  const auto reader = film_file::Reader::open(choice_.file);
  if (!reader) return reader.error();
  const FilmHead& found = reader.value().head();
  std::string difference =
      find_difference(found.facts, head.facts, head.kinds.measured ? "" : samples_name);
  if (difference.empty()) difference = find_difference(found.share, head.share);
  if (!difference.empty()) return Diagnostic::in_file(choice_.file, difference);
  // A sample that is to be the only one lies at the pixel's centre, where none of several does.
  if (found.spp == 1 && head.spp > 1) return false;
  if (auto done = reader.value().read(sheet); !done) return done.error();
  const int most = sheet.most_samples(), usable = found.spp > 1 && head.spp == 1 ? 0 : head.spp;
  if (most <= usable) return true;
  return Diagnostic::in_file(
      choice_.file,
      fmt::format("has pixels of {}, expected --spp to be {} or more, not {}",
                  counted(static_cast<std::size_t>(most), "sample"), std::max(most, 2), head.spp));
}

Status Checkpoint::save(const FilmHead& head, const PartSheet& sheet) const {
  const WriteGuard guard;  // the film goes into a file without a name: nothing to remove
  return film_file::write(choice_.file, head, sheet, {});
}

void Checkpoint::remove(const std::string& output) const {
  std::error_code ignored;
  if (!std::filesystem::equivalent(choice_.file, output, ignored)) unlink(choice_.file.c_str());
}

}  // namespace boule::cli
