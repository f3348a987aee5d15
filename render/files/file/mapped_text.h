#pragma once

#include <cstddef>
#include <memory>
#include <string>
#include <string_view>

#include "core/base/error.h"
#include "render/files/file/growing_bytes.h"

namespace boule {

/// The bytes of a regular file, to be read at random: mapped into memory, so that only what is
/// read costs memory, or unpacked into memory if its content is packed (Packing).
///
/// Files of up to 16 MiB are read instead. A larger file that is not packed must keep its length
/// for as long as its text is used: if another program cuts it off, the system ends the process
/// that reads what is gone (SIGBUS). What is appended meanwhile is not seen.
class MappedText {
 public:
  /// What is done with packed bytes that end too early.
  enum class Cut { refuse, keep };

  /// Opens `path`, any name. An error if it cannot be read, if the build cannot unpack it, if it
  /// is damaged, or if what it holds does not fit into memory, as soon as that is known.
  static Result<MappedText> open(const std::string& path, Cut cut = Cut::refuse);

  /// A text of its own, for what is not in a file.
  static MappedText of(std::string text);

  /// All bytes, unpacked, without a UTF-8 byte order mark. They stay where they are when this is
  /// moved.
  [[nodiscard]] std::string_view text() const { return text_; }

  /// Why the text is only the whole lines of what the file held (Cut::keep): a message.
  [[nodiscard]] const Status& whole() const { return whole_; }

  /// Says that a part of the text has been read. Where it is mapped, its memory goes back to the
  /// system; who asks for it once more reads it from the file.
  void let_go(std::string_view part) const;

 private:
  struct Unmap {
    std::size_t bytes;
    void operator()(void* map) const;
  };

  MappedText() = default;

  // One of these three holds the bytes.
  std::unique_ptr<const std::string> owned_;
  std::unique_ptr<void, Unmap> map_;
  GrowingBytes unpacked_;
  std::string_view text_;
  Status whole_;
};

}  // namespace boule
