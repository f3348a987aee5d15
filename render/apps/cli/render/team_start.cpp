#include "render/apps/cli/render/team_start.h"

#include <fmt/format.h>

#include <cstdlib>
#include <utility>

#include "core/base/version.h"
#include "render/apps/cli/process/file_owner.h"
#include "render/apps/cli/process/standard_error.h"
#include "render/apps/cli/report/movie.h"
#include "render/apps/cli/report/run_report.h"
#include "render/apps/team/mpi_launcher.h"
#include "render/apps/team/mpi_post.h"
#include "render/frame/scheduler.h"

namespace boule::cli {
namespace {

bool is_gone(const RankName& name) {
  FileOwner owner;
  owner.processes = name.processes;
  owner.process = name.process;
  return owner.is_gone();
}

/// The line goes to standard error whatever becomes of the others: all ranks end at once.
void tell_lost(const std::string& why) {
  write_last_line(("boule: error: " + why + "; all ranks end\n").c_str());
}

}  // namespace

Result<std::unique_ptr<Team>> join_team(const RenderCommand& command) {
  std::unique_ptr<Team> none;
  if (command.mpi == MpiUse::never) return none;
  const MpiLauncher launcher =
      find_mpi_launcher([](const char* name) { return std::getenv(name); });
  if (launcher.name.empty()) return none;
  const FileOwner self = FileOwner::self();
  TeamSettings settings;
  settings.name = {self.host, self.process, self.processes,
                   static_cast<int>(Scheduler(command.threads).workers())};
  settings.version = library_version();
  settings.is_gone = is_gone;
  settings.lost = tell_lost;
  auto team = Team::join([&launcher] { return open_mpi_post(launcher.module); }, settings);
  if (team) return team;
  return Diagnostic::of("started by " + launcher.name + " as one of several, but " +
                        team.error().message + "; --mpi never renders alone");
}

Status check_copies(const RenderCommand& command) {
  if (command.mpi == MpiUse::never || command.shard || command.claim) return {};
  const int copies = count_copies([](const char* name) { return std::getenv(name); });
  if (copies < 2) return {};
  const std::string together = command.frames ? "--claim or srun --mpi=pmix" : "srun --mpi=pmix";
  return wrong_option(
      fmt::format("srun started {} copies of this command, each of which would render all of it: "
                  "{} makes them work together, --mpi never renders {} times",
                  copies, together, copies),
      "--mpi");
}

Status check_team(const RenderCommand& command) {
  if (command.claim)
    return wrong_option("shares a series without MPI, which deals out frames itself", "--claim");
  if (is_movie_name(command.output))
    return wrong_option("a movie is made by one process: --mpi never makes it so", "--output");
  if (command.preview) return wrong_option("is for one process, not with MPI", "--preview");
  if (command.partial)
    return wrong_option("is for one process: with MPI it is --checkpoint", "--partial");
  return {};
}

RenderCommand command_of_rank(const RenderCommand& command) {
  RenderCommand own = command;
  own.verbosity = Verbosity::quiet;
  own.progress = ProgressStyle::none;
  own.stats = {};
  own.legend.clear();
  own.time_limit.reset();
  return own;
}

}  // namespace boule::cli
