#pragma once

#include <optional>
#include <string>

#include "core/base/error.h"
#include "render/apps/cli/options/options.h"
#include "render/apps/cli/process/exit_code.h"
#include "render/apps/cli/process/file_lock.h"
#include "render/apps/parts/film_file.h"

namespace boule::cli {

/// The checkpoint of one picture: a film file of its blocks so far, and the lock beside it.
class Checkpoint {
 public:
  /// Takes the lock FILE.lock. The Diagnostic, and `code` with it, tell why not: another process
  /// has it, or, without --resume, the file is there already.
  static Result<Checkpoint> open(const RenderCommand& command, ExitCode& code);

  /// With --resume: whether there is a checkpoint whose samples can be used; its blocks are then
  /// put into the sheet. They may be those of a run with another number of samples per pixel, the
  /// noise of which is not measured. An error if it is of another picture, by name, has pixels with
  /// more samples than are wanted, or is damaged.
  Result<bool> load(const FilmHead& head, PartSheet& sheet) const;

  /// Replaces the checkpoint. A signal does not end it.
  Status save(const FilmHead& head, const PartSheet& sheet) const;

  /// Removes it: the picture or film `output` is finished. If it is that film itself, it stays.
  void remove(const std::string& output) const;

  [[nodiscard]] const std::string& file() const { return choice_.file; }
  [[nodiscard]] double interval() const { return choice_.interval; }

 private:
  Checkpoint(TimedFile choice, bool resume, FileLock lock)
      : choice_(std::move(choice)), resume_(resume), lock_(std::move(lock)) {}

  TimedFile choice_;
  bool resume_;
  FileLock lock_;
};

}  // namespace boule::cli
