#pragma once

#include <string_view>

#include "core/scene/scene.h"
#include "render/files/scene_file/nff/nff_cursor.h"

namespace boule {

/// NFF's `v` block: the camera and the size of the picture, one member a line, in any order.
/// `hither` is read and ignored.
class NffCamera {
 public:
  /// Begins the block at `place`; false if there was one before.
  bool begin(TextPlace place);

  /// True between begin() and end().
  [[nodiscard]] bool is_open() const { return state_ == State::open; }
  /// True once there was a block.
  [[nodiscard]] bool is_there() const { return state_ != State::absent; }

  /// Reads the rest of the member line that begins with `name`; false if there is no such
  /// member.
  bool read_member(std::string_view name, NffCursor& line, FirstError& error);

  /// Ends the block: reports what is missing or wrong, else sets scene.camera and scene.image.
  void end(Scene& scene, FirstError& error);

 private:
  enum class State { absent, open, closed };

  static constexpr int member_count = 6;

  State state_ = State::absent;
  TextPlace start_;
  TextPlace places_[member_count];  // line 0: not given
  PinholeCamera camera_;
  float hither_ = 0;
  int width_ = 0, height_ = 0;
};

}  // namespace boule
