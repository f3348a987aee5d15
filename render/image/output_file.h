#pragma once

#include <cstddef>
#include <functional>
#include <string>

#include "core/base/error.h"

namespace boule {

/// "cannot write 'NAME': REASON", the form of every failure of an output.
Diagnostic cannot_write(const std::string& name, const std::string& reason);
/// The same with the system's text for an errno code as the reason.
Diagnostic cannot_write(const std::string& name, int code);

/// A file that appears under its name only when it is complete. Until then it is a temporary file
/// in the target's folder, which commit() renames and the destructor removes. Where the file system
/// allows it, the temporary file is nameless until then, so it disappears however the program ends.
/// A failure leaves an old file as it was.
///
/// The new file has the permissions of the old one, otherwise 0666 less the umask. A symbolic link
/// is followed: the file that it names is replaced, and the link stays. A link is refused if
/// another user put it into a folder to which everybody may write (/tmp), as with
/// fs.protected_symlinks. A device, pipe or socket is never replaced: the data are buffered in
/// memory, and commit() copies them into it. After commit(), and after a move, an OutputFile
/// refuses all calls below.
class OutputFile {
 public:
  /// Makes the temporary file. Takes any name; the Diagnostic (cannot_write) carries the system's
  /// reason. If the target is a FIFO without a reader, this waits for one and calls `stop` ten
  /// times a second; true ends the waiting. Exceptions of `stop` propagate to the caller, here and
  /// in commit().
  static Result<OutputFile> create(const std::string& target,
                                   const std::function<bool()>& stop = {});

  OutputFile(OutputFile&& other) noexcept;
  OutputFile& operator=(OutputFile&& other) noexcept;
  OutputFile(const OutputFile&) = delete;
  OutputFile& operator=(const OutputFile&) = delete;
  ~OutputFile();

  /// The path of the temporary file, for opening and checking it, and for removing it if the
  /// program ends early. A nameless file disappears by itself.
  [[nodiscard]] const std::string& path() const { return path_; }
  /// The descriptor of the temporary file, open for reading, writing and seeking.
  [[nodiscard]] int descriptor() const { return descriptor_; }

  /// Appends `count` bytes at the descriptor's position.
  Status write(const void* bytes, std::size_t count);

  /// Writes `count` bytes over the first ones, which have been written before.
  Status rewrite_start(const void* bytes, std::size_t count);

  /// Makes the data durable. After the last write, it saves commit() that time.
  Status sync();

  /// Makes the data durable and gives the file its name. Call it once, after the last write. `stop`
  /// is called before that, and ten times a second while the reader of a pipe is slow; true makes
  /// this fail with the reason "interrupted".
  Status commit(const std::function<bool()>& stop = {});

 private:
  OutputFile() = default;
  static Result<OutputFile> create_beside(OutputFile file, const std::string& real_target);
  static Result<OutputFile> create_stream(OutputFile file, bool is_fifo,
                                          const std::function<bool()>& stop);
  bool open_unnamed();
  int give_name();
  Status commit_stream(const std::function<bool()>& stop);
  void discard();

  std::string name_;         // of the target as the caller wrote it, for messages
  std::string real_target_;  // the target with its links resolved; empty for a stream
  std::string path_;         // of the temporary file; in /proc while it is nameless
  std::string temporary_;    // the name of the temporary file; empty while it is nameless
  int descriptor_ = -1;
  int stream_ = -1;      // of the device or pipe itself
  bool synced_ = false;  // all writes were before the last sync()
};

}  // namespace boule
