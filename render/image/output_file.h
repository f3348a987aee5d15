#pragma once

#include <cstddef>
#include <functional>
#include <string>

#include "core/base/error.h"

namespace boule {

/// "cannot write 'NAME': REASON", for every failure of an output.
Diagnostic cannot_write(const std::string& name, const std::string& reason);

/// A file that appears under its name only when it is complete: a temporary in the target's folder,
/// renamed by commit(), removed by the destructor. Where the file system can, it has no name until
/// then, so that nothing is left however the program ends. A failure leaves an old file untouched.
///
/// The new file has the old one's permissions, else 0666 less the umask. A symbolic link is
/// followed: the file it names is replaced, the link stays; but one that others put into a folder
/// which everybody may write to (/tmp) is refused, as by fs.protected_symlinks. A device, pipe or
/// socket is never replaced: the data are gathered in memory and copied into it by commit(). What
/// was committed, or moved away, refuses all below.
class OutputFile {
 public:
  /// Makes the temporary; the Diagnostic (cannot_write) carries the system's reason. Any name will
  /// do. A FIFO's reader is waited for: `stop` is asked ten times a second then, true gives up.
  /// What `stop` throws reaches the caller, here and below.
  static Result<OutputFile> create(const std::string& target,
                                   const std::function<bool()>& stop = {});

  OutputFile(OutputFile&& other) noexcept;
  OutputFile& operator=(OutputFile&& other) noexcept;
  OutputFile(const OutputFile&) = delete;
  OutputFile& operator=(const OutputFile&) = delete;
  ~OutputFile();

  /// The temporary: its path, to be opened and checked, or removed where the program ends early
  /// (one without a name cannot be, and need not), and its descriptor, open for reading, writing
  /// and seeking.
  [[nodiscard]] const std::string& path() const { return path_; }
  [[nodiscard]] int descriptor() const { return descriptor_; }

  /// Appends `count` bytes at the descriptor's position.
  Status write(const void* bytes, std::size_t count);

  /// Makes the data durable, after the last write, so that commit() takes no time for it.
  Status sync();

  /// Makes the data durable and gives the file its name; call it once, after the last write.
  /// `stop` is asked before that, and ten times a second while a pipe's reader is slow: true gives
  /// up, with "interrupted" as the reason.
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

  std::string name_;         // the target as the caller wrote it, for messages
  std::string real_target_;  // links resolved; empty for a stream
  std::string path_;         // of the temporary; under /proc while it has no name
  std::string temporary_;    // its name, if it has one
  int descriptor_ = -1;
  int stream_ = -1;      // the device or pipe itself
  bool synced_ = false;  // since the last write()
};

}  // namespace boule
