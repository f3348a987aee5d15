#include "render/files/particle_file/hdf5/hdf5_text_column.h"

#include <cmath>
#include <utility>

#include "core/base/text.h"

namespace boule {
namespace {

constexpr double largest_kind = 0x1p53;

/// In one line, with single blanks.
std::string with_single_blanks(std::string_view text) {
  return joined(words_of(text, " \t\r\n\v\f"), " ");
}

}  // namespace

std::vector<std::string> Hdf5TextColumn::texts() const {
  return {interner_.texts().begin(), interner_.texts().end()};
}

std::uint32_t Hdf5TextColumn::index_of(std::string_view text) {
  const std::uint32_t next = static_cast<std::uint32_t>(interner_.texts().size());
  bytes_.emplace_back(text);
  const std::uint32_t index = interner_.index_of(bytes_.back());
  if (index != next) bytes_.pop_back();
  return index;
}

/// The name of a code, or its digits.
Result<std::string> Hdf5TextColumn::text_of(const Hdf5File& file, double code) {
  if (texts_.kind == Hdf5Kind::codes) {
    if (!names_) {
      auto names = file.names_of(texts_.path);
      if (!names) return names.error();
      names_ = std::move(names).value();
    }
    if (const auto found = names_->find(code); found != names_->end())
      return with_single_blanks(found->second);
  }
  if (!(std::fabs(code) <= largest_kind))
    return Diagnostic::about(texts_.name, "a number is too large for a kind");
  return std::to_string(static_cast<long long>(code));
}

Status Hdf5TextColumn::read(const Hdf5File& file, std::uint64_t begin, std::size_t count,
                            std::vector<std::uint32_t>& indices) {
  Hdf5Extent start{}, extent{};
  const std::size_t axis = texts_.frame ? 1 : 0;
  if (texts_.frame) {
    start[0] = *texts_.frame;
    extent[0] = 1;
  }
  start.at(axis) = begin;
  extent.at(axis) = count;
  indices.reserve(indices.size() + count);
  if (texts_.kind == Hdf5Kind::texts) {
    std::string last;
    std::uint32_t index = 0;
    bool is_first = true;
    return file.read_texts(texts_.path, start, extent, [&](std::string_view text) {
      if (is_first || text != last) {
        last = text;
        index = index_of(with_single_blanks(text));
        is_first = false;
      }
      indices.push_back(index);
    });
  }
  std::vector<double> numbers(count);
  if (auto done = file.read(texts_.path, start, extent, numbers.data()); !done) return done;
  for (const double code : numbers) {
    auto found = codes_.find(code);
    if (found == codes_.end()) {
      const auto text = text_of(file, code);
      if (!text) return text.error();
      found = codes_.emplace(code, index_of(text.value())).first;
    }
    indices.push_back(found->second);
  }
  return {};
}

}  // namespace boule
