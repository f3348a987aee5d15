#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>

#include "core/math/color.h"
#include "core/math/vec.h"
#include "render/files/scene_file/loaded/first_error.h"
#include "render/files/scene_file/loaded/text_place.h"

namespace boule {

/// Goes through NFF text line by line and word by word, without allocating. Words are separated by
/// blanks; a word that begins with '#' ends its line. The functions that take a word report an
/// error under `key` and return false where it is not what they expect.
class NffCursor {
 public:
  /// `text` and `error` must outlive it.
  NffCursor(std::string_view text, FirstError& error, const Vec3d& origin = {})
      : rest_(text), error_(&error), origin_(origin) {}

  /// Goes to the next line that has a word; false at the end of the text.
  bool next_line();
  /// The next word of the line; empty at its end.
  std::string_view take_word();
  /// True if the line has no further word.
  bool at_line_end();

  /// A finite number.
  bool take(const char* key, double& out);
  /// The same, rounded to float once.
  bool take(const char* key, float& out);
  bool take(const char* key, Vec3f& out);
  /// A point, from which the origin is subtracted before it is rounded.
  bool take_point(const char* key, Vec3f& out);
  bool take(const char* key, Color& out);
  /// An integer of 32 bits.
  bool take(const char* key, int& out);
  /// The end of the line, or an error about the word that is there instead.
  bool take_line_end(const char* key);

  /// Where word `index` of this line begins; the first one is word 0. The end of the line if there
  /// is no such word.
  [[nodiscard]] TextPlace place(std::size_t index = 0) const;
  /// Behind the last word taken.
  [[nodiscard]] TextPlace end_place() const { return place_of(at_); }

 private:
  /// take() for words that are not simply a number: one with a '+', an underflow, an error.
  bool take_unusual(const char* key, double& out);
  bool take_from(const char* key, double zero, float& out);
  bool take_number_word(const char* key, const char* expected, std::string_view& word);
  bool report(std::string_view word, const char* key, std::string message);
  [[nodiscard]] TextPlace place_of(std::size_t offset) const;

  std::string_view rest_;  // what follows this line
  std::string_view line_;  // this line, without its comment
  std::size_t at_ = 0;     // how much of it is taken
  std::uint64_t number_ = 0;
  FirstError* error_;
  Vec3d origin_;
};

}  // namespace boule
