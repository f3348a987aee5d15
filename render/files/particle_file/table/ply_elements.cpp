#include "render/files/particle_file/table/ply_elements.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <optional>
#include <string>
#include <utility>

#include "render/files/particle_file/text/text_lines.h"

namespace boule {
namespace {

Diagnostic wrong_element(const PlyElement& element, std::string message) {
  return error_at_line(element.line, std::move(message), element.name);
}

Diagnostic ends_early(const PlyElement& element, std::uint64_t found) {
  return wrong_element(element, "it promises " + std::to_string(element.count) +
                                    " of these, the file ends after " + std::to_string(found));
}

bool has_property(const PlyElement& element, std::string_view name) {
  return std::any_of(element.properties.begin(), element.properties.end(),
                     [&](const PlyProperty& property) { return property.name == name; });
}

/// "scalar_radius" of CloudCompare is "radius", unless there is one of that name.
std::string column_name(const PlyElement& vertex, const std::string& name) {
  constexpr std::string_view prefix = "scalar_";
  if (!name.starts_with(prefix)) return name;
  std::string bare = name.substr(prefix.size());
  if (bare == "Radius") bare = "radius";
  return bare.empty() || has_property(vertex, bare) ? name : bare;
}

/// The number that stands for 1: the largest of a whole type, for colours.
double divisor_of(const PlyProperty& property) {
  constexpr std::array colors{"red", "green", "blue", "alpha"};
  const bool is_color = std::count(colors.begin(), colors.end(), property.name) > 0;
  if (!is_color || property.type.kind != BinaryKind::unsigned_integer) return 1;
  return std::ldexp(1.0, static_cast<int>(8 * property.type.width)) - 1;
}

Result<BinaryTable> table_of(const PlyElement& vertex, PlyEncoding encoding) {
  BinaryTable table;
  for (const PlyProperty& property : vertex.properties) {
    if (property.count) {
      return wrong_element(vertex, "its property " + quote(property.name) +
                                       " is a list, expected one number a point");
    }
    table.columns.push_back({.name = column_name(vertex, property.name),
                             .kind = property.type.kind,
                             .width = property.type.width,
                             .offset = table.row_bytes,
                             .is_big_endian = encoding == PlyEncoding::big_endian,
                             .divisor = divisor_of(property)});
    table.row_bytes += property.type.width;
  }
  table.rows = static_cast<std::size_t>(vertex.count);
  if (auto done = check_binary_columns(table); !done) {
    done.error().line = place_number(vertex.line);
    return done.error();
  }
  return table;
}

/// A count in front of a list; nothing for negative ones.
std::optional<std::uint64_t> list_count(const char* bytes, PlyType type, bool is_big_endian) {
  std::uint64_t count = 0;
  for (std::size_t i = 0; i < type.width; ++i) {
    const std::size_t at = is_big_endian ? i : type.width - 1 - i;
    count = count << 8 | static_cast<unsigned char>(bytes[at]);
  }
  const std::uint64_t sign = std::uint64_t{1} << (8 * type.width - 1);
  if (type.kind == BinaryKind::integer && (count & sign) != 0) return std::nullopt;
  return count;
}

/// The bytes of one element with lists at the start of `rest`; nothing if it is cut off.
std::optional<std::size_t> element_bytes(std::string_view rest, const PlyElement& element,
                                         bool is_big_endian) {
  std::size_t at = 0;
  for (const PlyProperty& property : element.properties) {
    const std::size_t width = property.count ? property.count->width : property.type.width;
    if (rest.size() - at < width) return std::nullopt;
    if (property.count) {
      const auto count = list_count(rest.data() + at, *property.count, is_big_endian);
      const std::size_t room = (rest.size() - at - width) / property.type.width;
      if (!count || *count > room) return std::nullopt;
      at += static_cast<std::size_t>(*count) * property.type.width;
    }
    at += width;
  }
  return at;
}

/// The bytes of all of an element's data at the start of `rest`.
Result<std::size_t> data_bytes(std::string_view rest, const PlyElement& element,
                               bool is_big_endian) {
  if (!element.has_lists()) {
    const std::size_t bytes = element.fixed_bytes();
    if (bytes == 0) return std::size_t{0};
    const std::uint64_t room = rest.size() / bytes;
    if (element.count > room) return ends_early(element, room);
    return static_cast<std::size_t>(element.count) * bytes;
  }
  std::size_t at = 0;
  for (std::uint64_t i = 0; i < element.count; ++i) {
    const auto bytes = element_bytes(rest.substr(at), element, is_big_endian);
    if (!bytes) return ends_early(element, i);
    at += *bytes;
  }
  return at;
}

}  // namespace

Result<PlyVertices> find_ply_vertices(std::string_view bytes, const PlyHeader& header) {
  const auto vertex = std::find_if(header.elements.begin(), header.elements.end(),
                                   [](const PlyElement& e) { return e.name == "vertex"; });
  if (vertex == header.elements.end()) return Diagnostic::of("it has no element 'vertex'");
  auto table = table_of(*vertex, header.encoding);
  if (!table) return table.error();
  PlyVertices found{.element = static_cast<std::size_t>(vertex - header.elements.begin()),
                    .table = std::move(table).value(),
                    .begin = header.bytes,
                    .end = header.bytes,
                    .line = header.lines + 1};
  for (auto element = header.elements.begin(); element <= vertex; ++element) {
    const std::string_view rest = bytes.substr(found.begin);
    std::size_t size = 0;
    if (header.encoding == PlyEncoding::ascii) {
      TextLines lines(rest);
      const std::uint64_t rows = lines.skip(element->count);
      if (rows < element->count) return ends_early(*element, rows);
      size = lines.offset();
      if (element != vertex) found.line += rows;
    } else {
      auto data = data_bytes(rest, *element, header.encoding == PlyEncoding::big_endian);
      if (!data) return data.error();
      size = data.value();
    }
    found.end = found.begin + size;
    if (element != vertex) found.begin = found.end;
  }
  return found;
}

}  // namespace boule
