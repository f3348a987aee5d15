#include "render/files/particle_file/hdf5/hdf5_parts.h"

#include <algorithm>
#include <utility>

#include "render/files/particle_file/frame/frame_check.h"
#include "render/memory/available_memory.h"

namespace boule {
namespace {

/// So many particles are read at a time where numbers do not stand as they are needed.
constexpr std::size_t particles_at_once = std::size_t{1} << 16;

Hdf5TextColumn hdf5_text_column(const Hdf5Texts& texts) { return Hdf5TextColumn(texts); }

}  // namespace

Hdf5Parts::Hdf5Parts(std::shared_ptr<const Hdf5File> file, Hdf5Layout layout,
                     ParticleFileOptions options)
    : file_(std::move(file)), layout_(std::move(layout)), options_(std::move(options)) {
  if (layout_.species) texts_.push_back(hdf5_text_column(*layout_.species));
  // Those that tell elements are read in any case.
  const bool tell = !layout_.species && layout_.species_name.empty();
  for (const Hdf5Texts& one : layout_.texts) {
    const bool is_told = tell && (one.name == "name" || one.name == "resname");
    if (is_told || is_wanted(options_.wanted, one.name)) {
      texts_.push_back(hdf5_text_column(one));
    } else {
      layout_.facts.unread.push_back(one.name);
    }
  }
}

bool Hdf5Parts::guesses_species() const {
  if (layout_.species || !layout_.species_name.empty()) return false;
  return std::any_of(texts_.begin(), texts_.end(),
                     [](const Hdf5TextColumn& one) { return one.name() == "name"; });
}

Status Hdf5Parts::find_texts() {
  for (Hdf5TextColumn& column : texts_) {
    std::vector<std::uint32_t> indices;
    for (std::uint64_t begin = 0; begin < size(); begin += particles_at_once) {
      indices.clear();
      const auto count =
          static_cast<std::size_t>(std::min<std::uint64_t>(particles_at_once, size() - begin));
      if (auto done = column.read(*file_, begin, count, indices); !done) return done;
    }
  }
  return {};
}

/// Calls read(part, its range, where it begins in the range) for the parts of the frame in a range.
template <class Read>
Status Hdf5Parts::each_part(const Range& range, const Read& read) const {
  std::uint64_t first = 0;
  for (std::size_t i = 0; i < layout_.parts.size(); ++i) {
    const std::uint64_t end = first + layout_.parts[i].count;
    const std::uint64_t from = std::max(first, range.begin);
    const std::uint64_t to = std::min(end, range.begin + range.count);
    if (from < to) {
      const Range inside{from - first, static_cast<std::size_t>(to - from)};
      if (auto done = read(i, inside, static_cast<std::size_t>(from - range.begin)); !done)
        return done;
    }
    first = end;
  }
  return {};
}

Status Hdf5Parts::read_numbers(const Hdf5Numbers& numbers, std::size_t width, const Range& range,
                               double* to) const {
  if (numbers.path.empty()) {
    std::fill(to, to + range.count * width, numbers.value);
    return {};
  }
  Hdf5Extent start{}, count{};
  std::size_t axis = 0;
  if (numbers.frame) {
    start[0] = *numbers.frame;
    count[0] = 1;
    axis = 1;
  }
  start.at(axis) = range.begin;
  count.at(axis) = range.count;
  if (numbers.has_rows) count.at(axis + 1) = width;
  return file_->read(numbers.path, start, count, to);
}

/// Centres whose axes have datasets of their own.
Status Hdf5Parts::read_axes(const Hdf5Places& places, const Range& range, Vec3d* to) const {
  constexpr std::array axes{&Vec3d::x, &Vec3d::y, &Vec3d::z};
  std::vector<double> numbers, offsets;
  for (std::size_t done = 0; done < range.count; done += particles_at_once) {
    const Range part{range.begin + done, std::min(particles_at_once, range.count - done)};
    numbers.resize(part.count);
    offsets.resize(part.count);
    for (std::size_t k = 0; k < 3; ++k) {
      if (auto read = read_numbers(places.axes[k], 1, part, numbers.data()); !read) return read;
      if (auto read = read_numbers(places.offsets[k], 1, part, offsets.data()); !read) return read;
      for (std::size_t i = 0; i < part.count; ++i)
        to[done + i].*axes[k] = numbers[i] + offsets[i] * places.factors[k];
    }
  }
  return {};
}

Status Hdf5Parts::read_places(const Range& range, std::vector<Vec3d>& positions) const {
  static_assert(sizeof(Vec3d) == 3 * sizeof(double));
  positions.resize(range.count);
  return each_part(range, [&](std::size_t i, const Range& part, std::size_t at) {
    const Hdf5Places& places = layout_.parts[i].places;
    Vec3d* const to = positions.data() + at;
    if (places.axes.size() == 3) return read_axes(places, part, to);
    return read_numbers(places.axes.front(), 3, part, &to->x);
  });
}

/// Its columns that are wanted, as far as they have names of their own.
Status Hdf5Parts::read_array(const Hdf5Array& array, const Range& range,
                             ParticleFrame& frame) const {
  const std::size_t width = array.names.size();
  std::vector<std::size_t> columns(width);  // places among the numbers + 1; 0: none
  for (std::size_t k = 0; k < width; ++k) {
    const std::string& name = array.names[k];
    if (!is_free_name(frame, name)) continue;
    if (!is_wanted(options_.wanted, name)) {
      frame.unread.push_back(name);
      continue;
    }
    frame.numbers.push_back({name, std::vector<double>(range.count)});
    columns[k] = frame.numbers.size();
  }
  if (std::all_of(columns.begin(), columns.end(), [](std::size_t at) { return at == 0; }))
    return {};
  std::vector<double> rows;
  return each_part(range, [&](std::size_t i, const Range& part, std::size_t at) -> Status {
    const Hdf5Numbers& numbers = array.parts[i];
    if (width == 1)
      return read_numbers(numbers, 1, part, frame.numbers[columns[0] - 1].values.data() + at);
    for (std::size_t done = 0; done < part.count; done += particles_at_once) {
      const Range some{part.begin + done, std::min(particles_at_once, part.count - done)};
      rows.resize(some.count * width);
      if (auto read = read_numbers(numbers, width, some, rows.data()); !read) return read;
      for (std::size_t k = 0; k < width; ++k) {
        if (columns[k] == 0) continue;
        double* const to = frame.numbers[columns[k] - 1].values.data() + at + done;
        for (std::size_t n = 0; n < some.count; ++n) to[n] = rows[n * width + k];
      }
    }
    return {};
  });
}

Status Hdf5Parts::read_texts(const Range& range, ParticleFrame& frame) {
  for (std::size_t i = 0; i < texts_.size(); ++i) {
    Hdf5TextColumn& column = texts_[i];
    const bool are_species = i == 0 && layout_.species;
    if (!are_species && !is_free_name(frame, column.name())) continue;
    TextColumn read{column.name(), {}, {}};
    for (std::size_t done = 0; done < range.count; done += particles_at_once) {
      const std::size_t count = std::min(particles_at_once, range.count - done);
      if (auto got = column.read(*file_, range.begin + done, count, read.indices); !got) return got;
    }
    read.texts = column.texts();
    if (are_species) {
      frame.species = std::move(read);
    } else {
      frame.texts.push_back(std::move(read));
    }
  }
  return {};
}

TextColumn Hdf5Parts::kinds_of_parts(const Range& range) const {
  TextColumn kinds{layout_.species_name, {}, std::vector<std::uint32_t>(range.count)};
  for (const Hdf5Layout::Part& part : layout_.parts) kinds.texts.push_back(part.kind);
  const Status done =
      each_part(range, [&](std::size_t i, const Range& part, std::size_t at) -> Status {
        const auto from = kinds.indices.begin() + static_cast<std::ptrdiff_t>(at);
        std::fill(from, from + static_cast<std::ptrdiff_t>(part.count),
                  static_cast<std::uint32_t>(i));
        return {};
      });
  return kinds;
}

Result<ParticleFrame> Hdf5Parts::read(std::uint64_t begin, std::size_t count) {
  std::uint64_t each = sizeof(Vec3d) + sizeof(std::uint32_t) * (texts_.size() + 1);
  for (const Hdf5Array& array : layout_.arrays) each += sizeof(double) * array.names.size();
  const std::uint64_t most = UINT64_MAX / each;
  if (auto done = check_memory(count > most ? UINT64_MAX : count * each,
                               std::to_string(count) + " particles need");
      !done) {
    return done.error();
  }
  const Range range{begin, count};
  ParticleFrame frame = layout_.facts;
  if (count != size()) frame.part = {begin, size()};
  if (auto done = read_places(range, frame.positions); !done) return done.error();
  if (!layout_.species_name.empty()) frame.species = kinds_of_parts(range);
  for (const Hdf5Array& array : layout_.arrays) {
    if (auto done = read_array(array, range, frame); !done) return done.error();
  }
  if (auto done = read_texts(range, frame); !done) return done.error();
  if (auto done = check_values(frame, options_.lenient, begin); !done) return done.error();
  return frame;
}

}  // namespace boule
