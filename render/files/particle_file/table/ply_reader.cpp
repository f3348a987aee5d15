#include <algorithm>
#include <cstdint>
#include <memory>
#include <utility>

#include "render/files/particle_file/frame/particle_format.h"
#include "render/files/particle_file/table/ply_elements.h"
#include "render/files/particle_file/table/ply_header.h"
#include "render/files/particle_file/text/named_columns.h"
#include "render/files/particle_file/text/text_lines.h"
#include "render/files/particle_file/text/text_rows.h"

namespace boule {
namespace {

class PlyReader : public ParticleReader {
 public:
  PlyReader(MappedText bytes, ParticleFileOptions options, PlyHeader header, PlyVertices vertices)
      : bytes_(std::move(bytes)),
        options_(std::move(options)),
        header_(std::move(header)),
        vertices_(std::move(vertices)) {}

  [[nodiscard]] std::size_t frames() const override { return 1; }

  Result<ParticleFrame> read(std::size_t, const ParallelFor& parallel_for) override {
    auto frame = header_.encoding == PlyEncoding::ascii
                     ? read_text(parallel_for)
                     : read_binary_table(vertices_.table, bytes_.text().data() + vertices_.begin,
                                         options_, parallel_for);
    if (frame) tell_what_is_left_out(frame.value());
    return frame;
  }

 private:
  Result<ParticleFrame> read_text(const ParallelFor& parallel_for) {
    ParticleFrame frame;
    NamedColumns columns(options_.wanted, frame);
    for (const BinaryColumn& column : vertices_.table.columns) {
      const bool is_axis = column.name == "x" || column.name == "y" || column.name == "z";
      if (is_axis) {
        columns.add(column.name, "0");
      } else {
        columns.add_kept(column.name, ColumnUse::number);
      }
    }
    const std::size_t size = vertices_.end - vertices_.begin;
    const TextRows rows{.text = bytes_.text().substr(vertices_.begin, size),
                        .rows = vertices_.table.rows,
                        .first_line = vertices_.line,
                        .lenient = options_.lenient,
                        .file = &bytes_};
    if (auto done = read_text_rows(rows, columns.columns(), frame, parallel_for); !done)
      return done.error();
    for (const BinaryColumn& column : vertices_.table.columns) {
      if (auto done = divide(column, frame); !done) return done.error();
    }
    columns.finish();
    return frame;
  }

  /// Colours of whole numbers are from 0 to 1, as in binary files.
  [[nodiscard]] Status divide(const BinaryColumn& column, ParticleFrame& frame) const {
    if (column.divisor == 1) return {};
    const auto found = std::find_if(frame.numbers.begin(), frame.numbers.end(),
                                    [&](const NumberColumn& c) { return c.name == column.name; });
    if (found == frame.numbers.end()) return {};
    for (std::size_t row = 0; row < found->values.size(); ++row) {
      double& value = found->values[row];
      if (!options_.lenient && (value < 0 || value > column.divisor)) {
        const auto largest = static_cast<std::uint64_t>(column.divisor);
        return error_at_line(vertices_.line + row,
                             "expected a number from 0 to " + std::to_string(largest), column.name);
      }
      value /= column.divisor;
    }
    return {};
  }

  void tell_what_is_left_out(ParticleFrame& frame) const {
    for (std::size_t i = 0; i < header_.elements.size(); ++i) {
      const PlyElement& element = header_.elements[i];
      if (i == vertices_.element || element.count == 0) continue;
      frame.notes.push_back("left out " + std::to_string(element.count) + " of the element " +
                            quote(element.name) + ": particles are the element 'vertex'");
    }
  }

  MappedText bytes_;
  ParticleFileOptions options_;
  PlyHeader header_;
  PlyVertices vertices_;
};

Result<std::unique_ptr<ParticleReader>> open_ply(MappedText bytes,
                                                 const ParticleFileOptions& options,
                                                 const ParallelFor&) {
  auto header = parse_ply_header(bytes.text());
  if (!header) return header.error();
  auto vertices = find_ply_vertices(bytes.text(), header.value());
  if (!vertices) return vertices.error();
  return std::unique_ptr<ParticleReader>(std::make_unique<PlyReader>(
      std::move(bytes), options, std::move(header).value(), std::move(vertices).value()));
}

bool starts_like_ply(std::string_view start) {
  return start.starts_with("ply\n") || start.starts_with("ply\r\n");
}

}  // namespace

constinit const ParticleFormat ply_format = {.name = "ply",
                                             .endings = {"ply"},
                                             .starts_like = starts_like_ply,
                                             .open = open_ply,
                                             .names_columns = true};

}  // namespace boule
