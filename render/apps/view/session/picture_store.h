#pragma once

#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <vector>

namespace boule::view {

/// A picture that a client may fetch: a file's bytes and name.
struct SavedPicture {
  std::string name;
  std::string bytes;
};

/// The last few pictures that were saved. Any thread may use it.
class PictureStore {
 public:
  static constexpr std::size_t kept = 3;

  /// Adds a picture; returns its number. The oldest goes where there are too many.
  int add(SavedPicture picture) {
    const std::lock_guard lock(mutex_);
    if (pictures_.size() == kept) pictures_.erase(pictures_.begin());
    pictures_.emplace_back(++last_, std::make_shared<const SavedPicture>(std::move(picture)));
    return last_;
  }

  /// Null if it is not there, or not any more.
  [[nodiscard]] std::shared_ptr<const SavedPicture> find(int number) const {
    const std::lock_guard lock(mutex_);
    for (const auto& [known, picture] : pictures_) {
      if (known == number) return picture;
    }
    return nullptr;
  }

 private:
  mutable std::mutex mutex_;
  int last_ = 0;
  std::vector<std::pair<int, std::shared_ptr<const SavedPicture>>> pictures_;
};

}  // namespace boule::view
