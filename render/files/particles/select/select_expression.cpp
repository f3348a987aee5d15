#include "render/files/particles/select/select_expression.h"

#include <algorithm>
#include <array>
#include <optional>
#include <utility>

#include "render/files/particles/select/select_tokens.h"

namespace boule {
namespace {

std::optional<Comparison> comparison_in(const SelectToken& token) {
  constexpr std::array<std::string_view, 6> signs{"<", "<=", "==", "!=", ">=", ">"};
  if (token.kind != SelectToken::Kind::sign) return std::nullopt;
  const auto found = std::find(signs.begin(), signs.end(), token.text);
  if (found == signs.end()) return std::nullopt;
  return static_cast<Comparison>(found - signs.begin());
}

std::string found_text(const SelectToken& token) {
  return token.kind == SelectToken::Kind::end ? "found the end" : "found " + quote(token.text);
}

/// Recursive descent: || of && of ( ), !( ) and comparisons.
class Parser {
 public:
  Parser(std::string_view text, const std::string& key) : tokens_(text, key) {}

  Result<SelectExpression> parse() {
    if (advance() && parse_either() && token_.kind != SelectToken::Kind::end) {
      fail(token_, comparison_in(token_) ? "comparisons do not chain, join two of them with &&"
                                         : "expected && or ||, " + found_text(token_));
    }
    if (!status_) return status_.error();
    return std::move(expression_);
  }

 private:
  static constexpr int most_nested = 100;

  bool fail(const SelectToken& token, const std::string& message) {
    status_ = tokens_.error(token.place, message);
    return false;
  }

  bool advance() {
    auto next = tokens_.next();
    if (!next) {
      status_ = next.error();
      return false;
    }
    token_ = next.value();
    return true;
  }

  [[nodiscard]] bool at(std::string_view sign) const {
    return token_.kind == SelectToken::Kind::sign && token_.text == sign;
  }

  void add(SelectStep::Kind kind) {
    SelectStep step;
    step.kind = kind;
    expression_.steps.push_back(step);
  }

  bool parse_either() {
    if (!parse_both()) return false;
    while (at("||")) {
      if (!advance() || !parse_both()) return false;
      add(SelectStep::Kind::either);
    }
    return true;
  }

  bool parse_both() {
    if (!parse_one()) return false;
    while (at("&&")) {
      if (!advance() || !parse_one()) return false;
      add(SelectStep::Kind::both);
    }
    return true;
  }

  bool parse_one() {
    bool negated = false;
    for (; at("!"); negated = !negated) {
      if (!advance()) return false;
      if (!at("!") && !at("(")) return fail(token_, "expected ( after !, " + found_text(token_));
    }
    if (!at("(")) return parse_comparison();
    if (!parse_nested()) return false;
    if (negated) add(SelectStep::Kind::negate);
    return true;
  }

  bool parse_nested() {
    const SelectToken opening = token_;
    if (nested_ == most_nested) return fail(opening, "the parentheses are nested too deeply");
    ++nested_;
    if (!advance() || !parse_either()) return false;
    --nested_;
    if (at(")")) return advance();
    if (token_.kind == SelectToken::Kind::end)
      return fail(opening, "this parenthesis is not closed");
    return fail(token_, comparison_in(token_) ? "comparisons do not chain, join two of them with &&"
                                              : "expected && or || or ), " + found_text(token_));
  }

  bool parse_comparison() {
    SelectStep step;
    if (!parse_value(step.left)) return false;
    const auto comparison = comparison_in(token_);
    if (!comparison) {
      return fail(token_, "expected a comparison (< <= == != >= >), " + found_text(token_));
    }
    step.comparison = *comparison;
    step.place = token_.place;
    if (!advance() || !parse_value(step.right)) return false;
    expression_.steps.push_back(std::move(step));
    return true;
  }

  bool parse_value(SelectValue& value) {
    switch (token_.kind) {
      case SelectToken::Kind::number:
        value = token_.number;
        break;
      case SelectToken::Kind::name:
        value = ColumnName{std::string(token_.text), token_.place};
        break;
      case SelectToken::Kind::text:
        value = std::string(token_.text);
        break;
      case SelectToken::Kind::sign:
      case SelectToken::Kind::end:
        return fail(token_,
                    "expected a column, a number or a text in quotes, " + found_text(token_));
    }
    return advance();
  }

  SelectTokens tokens_;
  SelectToken token_;
  SelectExpression expression_;
  Status status_;
  int nested_ = 0;
};

}  // namespace

std::size_t SelectExpression::depth() const {
  std::size_t now = 0, most = 0;
  for (const SelectStep& step : steps) {
    if (step.kind == SelectStep::Kind::compare) most = std::max(most, ++now);
    if (step.kind == SelectStep::Kind::both || step.kind == SelectStep::Kind::either) --now;
  }
  return most;
}

Result<SelectExpression> parse_select(std::string_view text, const std::string& key) {
  return Parser(text, key).parse();
}

}  // namespace boule
