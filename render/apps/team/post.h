#pragma once

#include <optional>
#include <string>
#include <string_view>

namespace boule {

/// A letter and its sender.
struct Letter {
  int from = 0;
  std::string bytes;
};

/// Carries letters between the ranks of a team. Letters from one rank to another arrive in their
/// order. One thread uses it.
class Post {
 public:
  Post() = default;
  Post(const Post&) = delete;
  Post& operator=(const Post&) = delete;
  virtual ~Post() = default;

  [[nodiscard]] virtual int rank() const = 0;
  [[nodiscard]] virtual int size() const = 0;
  /// Sends at most 2^30 bytes, and does not wait.
  virtual void send(int to, std::string_view bytes) = 0;
  /// A letter, if one has come.
  virtual std::optional<Letter> receive() = 0;
  /// Whether all letters of this rank have left.
  virtual bool idle() = 0;
  /// Leaves in order, when all ranks do.
  virtual void finish() = 0;
  /// Ends all ranks at once.
  virtual void end_all(int code) = 0;
};

}  // namespace boule
