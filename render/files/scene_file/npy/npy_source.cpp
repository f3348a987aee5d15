#include "render/files/scene_file/npy/npy_source.h"

#include <unistd.h>

#include <algorithm>
#include <utility>

#include "render/files/file/npy_header.h"
#include "render/files/file/npy_rows.h"
#include "render/files/scene_file/npy/npy_reader.h"

namespace boule {

Status NpySource::named(const File& file, Status status) {
  if (!status) status.error().file = file.is_pipe ? "standard input" : file.name;
  return status;
}

Result<std::unique_ptr<NpySource>> NpySource::open(const std::vector<std::string>& paths,
                                                   const std::string& beside,
                                                   const ParallelFor& parallel_for) {
  std::unique_ptr<NpySource> source(new NpySource(parallel_for));
  for (const std::string& path : paths) {
    if (auto done = source->add(path); !done) {
      done.error().file = path == "-" ? "standard input" : path;
      return done.error();
    }
  }
  if (source->files_.front().is_pipe) {
    auto spool = SpillFile::create(beside);
    if (!spool) return spool.error();
    source->spool_.emplace(std::move(spool).value());
  }
  return Result<std::unique_ptr<NpySource>>(std::move(source));
}

Status NpySource::add(const std::string& path) {
  const bool is_pipe = path == "-";
  auto opened = is_pipe ? InputFile::standard_input() : InputFile::open(path);
  if (!opened) return opened.error();
  InputFile& file = opened.value();
  const auto read = read_npy_header(file);
  if (!read) return read.error();
  const NpyHeader& header = read.value();
  if (auto done = check_npy_elements(header); !done) return done;
  if (header.shape.size() != 2 || header.shape[1] != 4) {
    return Diagnostic::of("has shape " + npy_shape_text(header) +
                          ", expected (N, 4): centre and radius");
  }
  const std::size_t width = npy_is_double(header) ? 8 : 4;
  if (!is_pipe) {
    if (auto done = check_npy_length(header, 4 * width, file.size()); !done) return done;
  }
  files_.push_back({path, std::move(file), header.size, header.shape[0], width, is_pipe});
  return {};
}

Status NpySource::seek(std::uint64_t sphere) {
  next_ = sphere;
  return {};
}

void NpySource::forget(std::uint64_t before) {
  if (!spool_) return;
  const std::uint64_t bytes = before * files_.front().row_bytes();
  spool_->forget(forgotten_, bytes - forgotten_);
  forgotten_ = bytes;
}

Status NpySource::next_rows(std::size_t most, Rows& rows) {
  rows = {};
  std::uint64_t before = 0;
  for (File& file : files_) {
    if (next_ >= before && next_ - before < file.rows) {
      const std::uint64_t first = next_ - before;
      const auto count = static_cast<std::size_t>(std::min<std::uint64_t>(most, file.rows - first));
      rows = {&file, first, count};
      next_ += count;
      return named(file, read_rows(file, first, count));
    }
    before += file.rows;
  }
  return {};
}

Status NpySource::read(std::vector<Sphere>& part, std::size_t most) {
  part.clear();
  Rows rows;
  if (auto done = next_rows(most, rows); !done) return done;
  if (rows.file == nullptr) return {};
  part.resize(rows.count);
  return named(*rows.file, decode_spheres(rows_.data(), rows.file->width, rows.first, origin_, part,
                                          parallel_for_));
}

Result<SphereExtent> NpySource::extent() {
  constexpr std::size_t at_once = std::size_t{1} << 20;
  SphereExtent all;
  Rows rows;
  do {
    if (auto done = next_rows(at_once, rows); !done) return done.error();
    all.add(extent_of(rows.count, parallel_for_, [&](std::size_t i, SphereExtent& extent) {
      const File& file = *rows.file;
      const auto number = [&, row = rows_.data() + i * file.row_bytes()](std::size_t column) {
        return npy_number_of(row + column * file.width, file.width);
      };
      extent.add({number(0), number(1), number(2)}, number(3));
    }));
  } while (rows.file != nullptr);
  next_ = 0;
  return all;
}

Status NpySource::read_rows(File& file, std::uint64_t first, std::size_t count) {
  rows_.resize(count * file.row_bytes());
  if (file.is_pipe) return read_pipe(file, first);
  const std::uint64_t offset = file.begin + first * file.row_bytes();
  if (::lseek(file.file.descriptor(), static_cast<off_t>(offset), SEEK_SET) < 0)
    return Diagnostic::of("cannot be read from a place of its own");
  return read_npy_rows(file.file, rows_.data(), rows_.size());
}

/// Rows that were read before come from the temporary file.
Status NpySource::read_pipe(File& file, std::uint64_t first) {
  const std::uint64_t offset = first * file.row_bytes();
  if (offset < spool_->size()) {
    const auto known =
        static_cast<std::size_t>(std::min<std::uint64_t>(spool_->size() - offset, rows_.size()));
    if (auto done = spool_->read(offset, rows_.data(), known); !done) return done;
    if (known == rows_.size()) return {};
    return read_pipe_on(file, known);
  }
  return read_pipe_on(file, 0);
}

Status NpySource::read_pipe_on(File& file, std::size_t begin) {
  const auto got = file.file.read(rows_.data() + begin, rows_.size() - begin);
  if (!got) return got.error();
  if (got.value() < rows_.size() - begin) {
    const std::uint64_t rows = (spool_->size() + got.value()) / file.row_bytes();
    return Diagnostic::of("declares " + std::to_string(file.rows) + " rows, but ends after " +
                          std::to_string(rows));
  }
  return spool_->append(rows_.data() + begin, rows_.size() - begin);
}

}  // namespace boule
