#include <array>
#include <cmath>
#include <cstdint>
#include <optional>
#include <utility>
#include <vector>

#include "render/files/particle_file/frame/element_guess.h"
#include "render/files/particle_file/frame/particle_format.h"
#include "render/files/particle_file/molecule/molecule_columns.h"
#include "render/files/particle_file/molecule/pdb_records.h"
#include "render/files/particle_file/text/text_lines.h"
#include "render/files/particle_file/text/text_number.h"

namespace boule {
namespace {

constexpr std::size_t numbers_end = 5;
constexpr std::array<const char*, numbers_end> number_names{"x", "y", "z", "charge", "radius"};

/// The words of an atom's record.
struct PqrWords {
  std::string_view id, name, residue, chain, residue_number;
  std::array<std::string_view, numbers_end> numbers;
};

bool are_numbers(const std::array<std::string_view, numbers_end>& words) {
  for (const std::string_view word : words) {
    if (!number_in(word)) return false;
  }
  return true;
}

/// The number of "52A", whose letter is an insertion code; 0 for other texts.
double residue_number_of(std::string_view word) {
  while (!word.empty() && !is_digit(word.back())) word.remove_suffix(1);
  return number_in(word).value_or(0);
}

/// By blanks, as the format says: ATOM id name residue [chain] number x y z charge radius. Nothing
/// where there are other words.
std::optional<PqrWords> by_blanks(std::string_view line) {
  constexpr std::size_t record = 6, least = 9;
  auto words = words_of(line.substr(line[0] == 'H' || line[0] == 'h' ? record : 4));
  if (words.size() < least || words.size() > least + 1) return std::nullopt;
  PqrWords found{.id = words[0], .name = words[1], .residue = words[2]};
  found.residue_number = words[words.size() - numbers_end - 1];
  if (words.size() > least) found.chain = words[3];
  if (found.residue_number.find_first_of("0123456789") == std::string_view::npos) return {};
  const char first = found.residue_number.front();
  if (words.size() == least && !is_digit(first) && first != '-') {
    found.chain = found.residue_number.substr(0, 1);  // "A1000"
    found.residue_number.remove_prefix(1);
  }
  std::copy(words.end() - numbers_end, words.end(), found.numbers.begin());
  return found;
}

/// By the columns of PDB, up to the positions. Charge and radius stand behind them.
PqrWords by_columns(std::string_view line) {
  const auto field = [&](std::size_t begin, std::size_t width) {
    return without_blanks(line.substr(std::min(begin, line.size()), width));
  };
  PqrWords found{.id = field(6, 5),
                 .name = field(12, 4),
                 .residue = field(17, 4),
                 .chain = field(21, 1),
                 .residue_number = field(22, 4),
                 .numbers = {field(30, 8), field(38, 8), field(46, 8), {}, {}}};
  const auto words = words_of(line.substr(std::min<std::size_t>(54, line.size())));
  found.numbers[3] = words.size() == 2 ? words[0] : field(54, 8);
  found.numbers[4] = words.size() == 2 ? words[1] : field(62, line.size());
  return found;
}

PqrWords words_of_atom(std::string_view line) {
  const auto blanks = by_blanks(line);
  if (blanks && are_numbers(blanks->numbers)) return *blanks;
  PqrWords columns = by_columns(line);  // words run together
  return blanks && !are_numbers(columns.numbers) ? *blanks : columns;
}

class PqrReader : public PlacedReader<PdbFrame> {
 public:
  using PlacedReader::PlacedReader;

  Result<ParticleFrame> read(std::size_t frame, const ParallelFor&) override {
    const PdbFrame& place = places_.frames[frame];
    MoleculeColumns columns(MoleculeKind::charges, options_.water);
    if (auto done = columns.reserve(place.atoms); !done) return done.error();
    std::size_t points = 0;
    TextLines lines(bytes_.text().substr(place.begin, place.end - place.begin));
    while (!lines.at_end()) {
      const std::uint64_t number = place.line + lines.line() - 1;
      const std::string_view line = lines.next();
      if (!is_pdb_atom(line)) continue;
      if (auto done = add_atom(line, number, columns, points); !done) return done.error();
    }
    ParticleFrame read = columns.finish(options_.wanted);
    read.axes_matter = false;
    if (points > 0) read.notes.push_back(points_text(points));
    return read;
  }

 private:
  static std::string points_text(std::size_t points) {
    return std::to_string(points) + (points == 1 ? " atom" : " atoms") +
           " of radius 0 left out: the file gives them no size";
  }

  /// Adds the atom, or counts it where it has no size and radii are asked for.
  Status add_atom(std::string_view line, std::uint64_t number, MoleculeColumns& columns,
                  std::size_t& points) const {
    const PqrWords words = words_of_atom(line);
    std::array<double, numbers_end> n{};
    for (std::size_t i = 0; i < numbers_end; ++i) {
      const auto found = number_in(words.numbers[i]);
      if (found && std::isfinite(*found)) {
        n[i] = *found;
        continue;
      }
      if (words.numbers[i].empty()) {
        return error_at_line(number, "the record has no number for " + quote(number_names[i]),
                             number_names[i]);
      }
      return error_at_word(number, line, words.numbers[i],
                           std::string("expected a ") + (found ? "finite " : "") +
                               "number, found " + quote(words.numbers[i]),
                           number_names[i]);
    }
    const bool has_size = n[4] != 0 || !is_wanted(options_.wanted, "radius");
    if (!has_size) return ++points, Status();
    columns.add({.position = {n[0], n[1], n[2]},
                 .element = element_of_atom(words.name, words.residue),
                 .is_guessed = true,
                 .name = words.name,
                 .residue = words.residue,
                 .chain = words.chain,
                 .residue_number = residue_number_of(words.residue_number),
                 .id = number_in(words.id).value_or(0),
                 .occupancy = n[3],
                 .b_factor = n[4]});
    return {};
  }
};

Result<std::unique_ptr<ParticleReader>> open_pqr(MappedText bytes,
                                                 const ParticleFileOptions& options,
                                                 const ParallelFor&) {
  return placed_reader<PqrReader>(find_pdb_frames(bytes.text(), !bytes.whole().ok()),
                                  std::move(bytes), options);
}

}  // namespace

// Its records look like those of PDB: only the ending tells.
constinit const ParticleFormat pqr_format = {.name = "pqr",
                                             .endings = {"pqr"},
                                             .open = open_pqr,
                                             .is_trajectory = true,
                                             .names_columns = true};

}  // namespace boule
