#pragma once

#include <cstddef>
#include <string>
#include <string_view>

#include "core/base/error.h"

namespace boule {

/// A piece of a selection's text.
struct SelectToken {
  enum class Kind { number, name, text, sign, end };
  Kind kind = Kind::end;
  std::string_view text;  ///< without its quotes
  double number = 0;
  std::size_t place = 1;  ///< of its first character, from 1
};

/// Goes through a selection's text token by token. Signs are ( ) ! && || and the comparisons.
class SelectTokens {
 public:
  SelectTokens(std::string_view text, std::string key) : text_(text), key_(std::move(key)) {}

  /// The next token.
  Result<SelectToken> next();

  /// An error at a character, from 1.
  [[nodiscard]] Diagnostic error(std::size_t place, const std::string& message) const;

 private:
  Result<SelectToken> number();
  Result<SelectToken> quoted();
  Result<SelectToken> sign();
  SelectToken token(SelectToken::Kind kind, std::size_t size);

  std::string_view text_;
  std::string key_;
  std::size_t at_ = 0;
};

}  // namespace boule
