#pragma once

#include <optional>
#include <string>

#include "core/base/error.h"
#include "render/cli/exit_code.h"
#include "render/cli/file_lock.h"
#include "render/cli/options.h"
#include "render/parts/film_file.h"

namespace boule::cli {

/// The checkpoint of one picture: a film file of its blocks so far, and the lock beside it.
class Checkpoint {
 public:
  /// Takes the lock FILE.lock. The Diagnostic, and `code` with it, tell why not: another process
  /// has it, or, without --resume, the file is there already.
  static Result<Checkpoint> open(const RenderCommand& command, ExitCode& code);

  /// With --resume: whether there is a checkpoint; its blocks are then put into the sheet. An error
  /// if it is of another picture, by name, or damaged.
  Result<bool> load(const FilmHead& head, PartSheet& sheet) const;

  /// Replaces the checkpoint. A signal does not end it.
  Status save(const FilmHead& head, const PartSheet& sheet) const;

  /// Removes it: the picture is finished.
  void remove() const;

  [[nodiscard]] const std::string& file() const { return choice_.file; }
  [[nodiscard]] double interval() const { return choice_.interval; }

 private:
  Checkpoint(CheckpointChoice choice, bool resume, FileLock lock)
      : choice_(std::move(choice)), resume_(resume), lock_(std::move(lock)) {}

  CheckpointChoice choice_;
  bool resume_;
  FileLock lock_;
};

}  // namespace boule::cli
