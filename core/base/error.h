#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <variant>

namespace boule {

/// An error: its message, and the place where it occurred. Lines and columns count from 1; 0 means
/// outside a file's text.
///
/// Functions that can fail return a Diagnostic in a Result or a Status. Unless a comment names
/// others, the only exception they throw is std::bad_alloc, when there is no memory even for the
/// Diagnostic.
struct Diagnostic {
  std::string message{};  ///< the error and the expected value; may repeat bytes of a file
  std::string key{};      ///< dotted path of the offending key ("camera.fov"), or empty
  std::string file{};     ///< the file that was read, or empty
  int line = 0;
  int column = 0;
  bool of_memory = false;  ///< too little memory is the cause

  /// An error without a key or a file.
  static Diagnostic of(std::string message) { return {.message = std::move(message)}; }

  /// An error for lack of memory.
  static Diagnostic out_of_memory(std::string message) {
    return {.message = std::move(message), .of_memory = true};
  }

  /// An error about a key, or about an option of the command line.
  static Diagnostic about(std::string key, std::string message) {
    return {.message = std::move(message), .key = std::move(key)};
  }

  /// An error about a whole file.
  static Diagnostic in_file(std::string file, std::string message) {
    return {.message = std::move(message), .file = std::move(file)};
  }
};

/// "FILE:LINE:COLUMN: error: MESSAGE (key 'KEY')", without unknown parts. The text is one line and
/// safe to print: control bytes are escaped. Throws std::bad_alloc.
std::string format_diagnostic(const Diagnostic& diagnostic);

/// External text, made safe to print. Control bytes, which could end a line or steer a terminal,
/// become `\xNN`; the text is cut to `longest` characters. Throws std::bad_alloc.
std::string printable(std::string_view text, std::size_t longest = std::string_view::npos);

/// printable() in quotation marks. Throws std::bad_alloc.
std::string quote(std::string_view text, std::size_t longest = 40);

/// Throws std::runtime_error with format_diagnostic(), or std::bad_alloc.
[[noreturn]] void throw_text(const Diagnostic& diagnostic);

/// A value, or the Diagnostic that explains its absence.
template <class T>
class [[nodiscard]] Result {
 public:
  Result(T value) : state_(std::in_place_index<0>, std::move(value)) {}
  Result(Diagnostic error) : state_(std::in_place_index<1>, std::move(error)) {}

  /// True if there is a value.
  [[nodiscard]] bool ok() const { return state_.index() == 0; }
  explicit operator bool() const { return ok(); }

  /// The value. Throws std::runtime_error with the text of the Diagnostic (format_diagnostic()) if
  /// not ok(): a program that does not catch it ends with that text.
  T& value() & {
    check();
    return std::get<0>(state_);
  }
  const T& value() const& {
    check();
    return std::get<0>(state_);
  }
  T&& value() && {
    check();
    return std::get<0>(std::move(state_));
  }

  /// The Diagnostic. Throws std::bad_variant_access if ok().
  [[nodiscard]] const Diagnostic& error() const { return std::get<1>(state_); }

 private:
  void check() const {
    if (!ok()) throw_text(error());
  }

  std::variant<T, Diagnostic> state_;
};

/// Success, or the Diagnostic that explains the failure.
class [[nodiscard]] Status {
 public:
  /// Success.
  Status() = default;
  Status(Diagnostic error) : error_(std::move(error)) {}

  /// True for success.
  [[nodiscard]] bool ok() const { return !error_; }
  explicit operator bool() const { return ok(); }

  /// The Diagnostic. Throws std::bad_optional_access if ok().
  [[nodiscard]] const Diagnostic& error() const { return error_.value(); }
  [[nodiscard]] Diagnostic& error() { return error_.value(); }

 private:
  std::optional<Diagnostic> error_;
};

}  // namespace boule
