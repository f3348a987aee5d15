#pragma once

#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "core/base/error.h"
#include "render/files/scene_file/loaded/text_place.h"

namespace boule {

struct SceneData;

/// Keeps the first error reported about one file; later ones are its consequences and dropped. A
/// reader reports an error and goes on, so that its code reads as the list of what it reads.
class FirstError {
 public:
  /// `frame` is the frame of a series that the file is read for; `data` are what the file may name
  /// besides files, or null.
  explicit FirstError(std::string file, std::optional<int> frame = {},
                      const SceneData* data = nullptr)
      : file_(std::move(file)), frame_(frame), data_(data) {}

  /// Reports an error in the file's text.
  void report(TextPlace place, std::string key, std::string message) {
    if (!status_) return;
    status_ = Diagnostic{.message = std::move(message),
                         .key = std::move(key),
                         .file = file_,
                         .line = place.line,
                         .column = place.column};
  }

  /// Reports an error of another file, which it names.
  void report(const Diagnostic& error) {
    if (status_) status_ = error;
  }

  /// The file the errors are about.
  [[nodiscard]] const std::string& file() const { return file_; }
  [[nodiscard]] std::optional<int> frame() const { return frame_; }
  [[nodiscard]] const SceneData* data() const { return data_; }

  /// Keeps the path of a data file that the file names.
  void add_data_file(std::string path) { data_files_.push_back(std::move(path)); }
  [[nodiscard]] const std::vector<std::string>& data_files() const { return data_files_; }

  /// Keeps a note for the user about what the file says.
  void add_note(std::string note) { notes_.push_back(std::move(note)); }
  [[nodiscard]] const std::vector<std::string>& notes() const { return notes_; }

  /// The first error, or nothing so far.
  [[nodiscard]] const Status& status() const { return status_; }

 private:
  std::string file_;
  std::optional<int> frame_;
  const SceneData* data_;
  Status status_;
  std::vector<std::string> data_files_;
  std::vector<std::string> notes_;
};

}  // namespace boule
