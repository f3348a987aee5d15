#include "render/files/particles/select/particle_select.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <optional>
#include <utility>

#include "core/base/chunks.h"
#include "render/files/particle_file/text/text_number.h"
#include "render/files/particles/particle_columns.h"
#include "render/files/particles/select/select_expression.h"

namespace boule {
namespace {

constexpr std::size_t select_block = 2048;

/// A step with its columns found. A comparison is of numbers, or it is an answer for each text.
struct FoundStep {
  SelectStep::Kind kind = SelectStep::Kind::compare;
  Comparison comparison{};
  bool with_missing = false;  ///< whether the left numbers are missing, by == or !=
  std::optional<ParticleNumbers> left, right;
  const std::uint32_t* texts = nullptr;
  std::vector<std::uint8_t> answers;
};

template <class T>
bool holds(Comparison comparison, const T& a, const T& b) {
  switch (comparison) {
    case Comparison::less:
      return a < b;
    case Comparison::less_equal:
      return a <= b;
    case Comparison::equal:
      return a == b;
    case Comparison::not_equal:
      return a != b;
    case Comparison::greater_equal:
      return a >= b;
    case Comparison::greater:
      break;
  }
  return a > b;
}

/// Finds the columns of steps.
class Finder {
 public:
  explicit Finder(const ParticleFrame& frame) : frame_(frame) {}

  Result<FoundStep> find(const SelectStep& step) const {
    FoundStep found;
    found.kind = step.kind;
    found.comparison = step.comparison;
    if (step.kind != SelectStep::Kind::compare) return found;
    if (is_missing_word(step.right)) return find_missing(step, step.left, found);
    if (is_missing_word(step.left)) return find_missing(step, step.right, found);
    const auto* const left_text = std::get_if<std::string>(&step.left);
    const auto* const right_text = std::get_if<std::string>(&step.right);
    if (left_text != nullptr) return find_texts(step, *left_text, step.right, found);
    if (right_text != nullptr) return find_texts(step, *right_text, step.left, found);
    auto right = numbers(step.right);
    if (!right) return right.error();  // first: a species without quotes stands there
    auto left = numbers(step.left);
    if (!left) return left.error();
    found.left = std::move(left).value();
    found.right = std::move(right).value();
    return found;
  }

 private:
  static Diagnostic error_at(std::size_t place, const std::string& message) {
    return Diagnostic::about("select", message + " (character " + std::to_string(place) + ")");
  }

  /// True for the word that stands for what is missing, unless a column has this name.
  [[nodiscard]] bool is_missing_word(const SelectValue& value) const {
    const auto* const word = std::get_if<ColumnName>(&value);
    if (word == nullptr) return false;
    if (word->name != "missing" && word->name != "null" && word->name != "nan") return false;
    return find_number_column(frame_, word->name) == nullptr &&
           find_particle_texts(frame_, word->name) == nullptr;
  }

  Result<FoundStep> find_missing(const SelectStep& step, const SelectValue& value,
                                 FoundStep found) const {
    if (step.comparison != Comparison::equal && step.comparison != Comparison::not_equal) {
      return error_at(step.place, "what is missing is only asked for by == and !=");
    }
    const auto* const column = std::get_if<ColumnName>(&value);
    if (column == nullptr) return error_at(step.place, "only a column can have missing values");
    const TextColumn* const texts = find_particle_texts(frame_, column->name);
    if (texts == nullptr || find_number_column(frame_, column->name) != nullptr) {
      auto left = numbers(value);
      if (!left) return left.error();
      found.left = std::move(left).value();
      found.with_missing = true;
      return found;
    }
    found.texts = texts->indices.data();
    for (const std::string& text : texts->texts) {
      const bool holds = is_missing_text(text) == (step.comparison == Comparison::equal);
      found.answers.push_back(holds ? 1 : 0);
    }
    return found;
  }

  Result<ParticleNumbers> numbers(const SelectValue& value) const {
    if (const auto* const number = std::get_if<double>(&value)) return ParticleNumbers(*number);
    const auto& [name, place] = std::get<ColumnName>(value);
    auto found = find_particle_numbers(frame_, name, "select");
    if (found) return found;
    if (find_particle_texts(frame_, name) != nullptr) {
      return error_at(place,
                      "the column " + quote(name) + " is of texts, compare it with one in quotes");
    }
    const bool is_text = frame_.species && std::count(frame_.species->texts.begin(),
                                                      frame_.species->texts.end(), name) > 0;
    return error_at(place, is_text
                               ? "there is no column " + quote(name) + "; species stand in quotes"
                               : found.error().message);
  }

  Result<FoundStep> find_texts(const SelectStep& step, const std::string& text,
                               const SelectValue& other, FoundStep found) const {
    const auto* const column = std::get_if<ColumnName>(&other);
    if (column == nullptr) return error_at(step.place, "a text can only be compared with a column");
    const TextColumn* const texts = find_particle_texts(frame_, column->name);
    const auto number = number_in(text);
    if (texts == nullptr) {
      auto numbers = find_particle_numbers(frame_, column->name, "select");
      if (!numbers) return error_at(column->place, numbers.error().message);
      if (!number) {
        return error_at(column->place, "the column " + quote(column->name) +
                                           " is of numbers, compare it with one");
      }
      found.left = std::move(numbers).value();
    }
    if (step.comparison != Comparison::equal && step.comparison != Comparison::not_equal) {
      return error_at(step.place, "texts are only compared by == and !=");
    }
    if (texts == nullptr) {
      found.right = ParticleNumbers(*number);
      return found;
    }
    found.texts = texts->indices.data();
    for (const std::string& one : texts->texts) {
      found.answers.push_back(holds(step.comparison, one, text) ? 1 : 0);
    }
    return found;
  }

  const ParticleFrame& frame_;
};

/// The stack of answers for one block of particles.
class Block {
 public:
  explicit Block(std::size_t depth)
      : answers_(depth * select_block), left_(select_block), right_(select_block) {}

  /// The answers of all steps for particles begin .. end - 1.
  const std::uint8_t* run(const std::vector<FoundStep>& steps, std::size_t begin, std::size_t end) {
    const std::size_t count = end - begin;
    std::uint8_t* top = answers_.data();
    for (const FoundStep& step : steps) {
      std::uint8_t* const last = top - select_block;
      if (step.kind == SelectStep::Kind::compare) {
        compare(step, begin, end, top);
        top += select_block;
      } else if (step.kind == SelectStep::Kind::negate) {
        for (std::size_t i = 0; i < count; ++i) last[i] ^= 1U;
      } else {
        std::uint8_t* const other = last - select_block;
        for (std::size_t i = 0; i < count; ++i) {
          other[i] = step.kind == SelectStep::Kind::both ? other[i] & last[i] : other[i] | last[i];
        }
        top = last;
      }
    }
    return answers_.data();
  }

 private:
  void compare(const FoundStep& step, std::size_t begin, std::size_t end, std::uint8_t* out) {
    const std::size_t count = end - begin;
    if (step.texts != nullptr) {
      for (std::size_t i = 0; i < count; ++i) out[i] = step.answers[step.texts[begin + i]];
      return;
    }
    step.left->read(begin, end, left_.data());
    if (step.with_missing) {
      const bool asked = step.comparison == Comparison::equal;
      for (std::size_t i = 0; i < count; ++i) out[i] = std::isnan(left_[i]) == asked ? 1 : 0;
      return;
    }
    step.right->read(begin, end, right_.data());
    for (std::size_t i = 0; i < count; ++i) {
      out[i] = holds(step.comparison, left_[i], right_[i]) ? 1 : 0;
    }
  }

  std::vector<std::uint8_t> answers_;
  std::vector<double> left_, right_;
};

template <class T>
void keep(std::vector<T>& values, const std::vector<std::uint8_t>& selected) {
  if (values.size() != selected.size()) return;  // columns that a reader leaves empty
  std::size_t kept = 0;
  for (std::size_t i = 0; i < values.size(); ++i) {
    values[kept] = values[i];
    kept += selected[i];
  }
  values.resize(kept);
  if (kept < values.capacity() / 2) values.shrink_to_fit();
}

}  // namespace

Result<std::vector<std::uint8_t>> select_particles(const ParticleFrame& frame,
                                                   const std::string& select,
                                                   const ParallelFor& parallel_for) {
  auto expression = parse_select(select, "select");
  if (!expression) return expression.error();
  std::vector<FoundStep> steps;
  for (const SelectStep& step : expression.value().steps) {
    auto found = Finder(frame).find(step);
    if (!found) return found.error();
    steps.push_back(std::move(found).value());
  }
  std::vector<std::uint8_t> selected(frame.size());
  const std::size_t depth = expression.value().depth();
  in_chunks(parallel_for, frame.size(), [&](std::size_t, std::size_t begin, std::size_t end) {
    Block block(depth);
    for (; begin < end; begin += select_block) {
      const std::size_t stop = std::min(begin + select_block, end);
      std::copy_n(block.run(steps, begin, stop), stop - begin, selected.data() + begin);
    }
  });
  return selected;
}

void keep_particles(ParticleFrame& frame, const std::vector<std::uint8_t>& selected,
                    const ParallelFor& parallel_for) {
  std::vector<std::function<void()>> lists{[&] { keep(frame.positions, selected); }};
  for (NumberColumn& column : frame.numbers) {
    lists.emplace_back([&] { keep(column.values, selected); });
  }
  for (TextColumn& column : frame.texts) {
    lists.emplace_back([&] { keep(column.indices, selected); });
  }
  if (frame.species) lists.emplace_back([&] { keep(frame.species->indices, selected); });
  lists.emplace_back([&] { keep_bonds(frame.bonds, selected); });
  parallel_for(lists.size(), [&](std::size_t i) { lists[i](); });
}

}  // namespace boule
