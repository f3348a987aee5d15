#include "render/files/packed/piece_checksum.h"

#include <algorithm>
#include <memory>
#include <vector>

namespace boule {
namespace {

std::string_view bytes_of_words(const std::uint64_t* values, std::size_t count) {
  return {reinterpret_cast<const char*>(values), count * sizeof *values};
}

}  // namespace

void PieceChecksum::add(std::string_view bytes) {
  while (!bytes.empty()) {
    if (!current_) current_ = std::make_unique<Checksum>();
    const std::string_view some = bytes.substr(0, piece - size_);
    current_->add(some);
    size_ += some.size();
    if (size_ == piece) end_piece();
    bytes.remove_prefix(some.size());
  }
}

void PieceChecksum::end_piece() {
  const std::uint64_t value = current_->value();
  pieces_.add(bytes_of_words(&value, 1));
  current_.reset();
  size_ = 0;
}

std::uint64_t PieceChecksum::value() {
  if (size_ > 0) end_piece();
  return pieces_.value();
}

std::uint64_t PieceChecksum::of_piece(std::string_view bytes) {
  Checksum checksum;
  checksum.add(bytes);
  return checksum.value();
}

std::uint64_t PieceChecksum::of_all(std::string_view bytes, const ParallelFor& parallel_for) {
  std::vector<std::uint64_t> pieces((bytes.size() + piece - 1) / piece);
  parallel_for(pieces.size(),
               [&](std::size_t i) { pieces[i] = of_piece(bytes.substr(i * piece, piece)); });
  return of_piece(bytes_of_words(pieces.data(), pieces.size()));
}

}  // namespace boule
