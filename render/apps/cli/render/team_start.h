#pragma once

#include <memory>

#include "core/base/error.h"
#include "render/apps/cli/options/options.h"
#include "render/apps/team/team.h"

namespace boule::cli {

/// The team of the processes that a launcher of MPI started with this one; null where there is none
/// or --mpi never is given.
Result<std::unique_ptr<Team>> join_team(const RenderCommand& command);

/// An error if a launcher started several copies of the command, each of which would render all of
/// it. Shards, series that are shared out, and --mpi never are for copies.
Status check_copies(const RenderCommand& command);

/// An error if the command is one that a team cannot work on together.
Status check_team(const RenderCommand& command);

/// The command of a rank that is not the leader: it tells nothing and writes no statistics.
RenderCommand command_of_rank(const RenderCommand& command);

}  // namespace boule::cli
