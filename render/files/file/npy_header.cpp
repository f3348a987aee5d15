#include "render/files/file/npy_header.h"

#include <algorithm>
#include <charconv>
#include <cstddef>
#include <system_error>

namespace boule {
namespace {

constexpr std::size_t most_dimensions = 8;
/// NumPy's own headers are 128 bytes; its readers refuse more than 10,000 by default.
constexpr std::uint64_t largest_header = 65536;
/// Values in one field of a structured type: far more than any particle has.
constexpr std::uint64_t largest_field = 65536;

Diagnostic broken(const std::string& what) {
  return Diagnostic::of("not a readable .npy file: " + what);
}

/// Reads the few Python literals that a header has; `ok` stays false after the first mismatch.
class LiteralReader {
 public:
  explicit LiteralReader(std::string_view text) : rest_(text) {}

  /// Skips blanks and takes `literal` if it comes next.
  bool take(std::string_view literal) {
    skip_blanks();
    if (rest_.substr(0, literal.size()) != literal) return false;
    rest_.remove_prefix(literal.size());
    return true;
  }

  /// A string in single or double quotes, without escapes.
  bool take_string(std::string& out) {
    const char mark = take("'") ? '\'' : take("\"") ? '"' : '\0';
    const std::size_t end = rest_.find(mark);
    if (mark == '\0' || end == std::string_view::npos) return false;
    out = rest_.substr(0, end);
    rest_.remove_prefix(end + 1);
    return true;
  }

  /// A type "<f4", or a list of fields: ('x', '<f4'), or with a shape ('pos', '<f8', (3,)).
  bool take_type(NpyHeader& out) {
    if (!take("[")) return take_string(out.descr);
    while (!take("]")) {
      NpyField& field = out.fields.emplace_back();
      if (!take("(") || !take_string(field.name) || !take(",")) return false;
      if (!take_string(field.descr)) return false;
      std::vector<std::uint64_t> shape;
      if (take(",") && !take_count_or_shape(shape)) return false;
      for (const std::uint64_t count : shape) {
        if (count > largest_field) return false;
        field.count *= count;
        if (field.count > largest_field) return false;
      }
      if (!take(")")) return false;
      if (!take(",")) return take("]") && !out.fields.empty();
    }
    return !out.fields.empty();
  }

  bool take_boolean(bool& out) {
    out = take("True");
    return out || take("False");
  }

  /// "(3, 4)", "(3,)" or "()"; a count beyond 64 bits is a mismatch.
  bool take_shape(std::vector<std::uint64_t>& out) {
    if (!take("(")) return false;
    while (!take(")")) {
      std::uint64_t count = 0;
      skip_blanks();
      const auto [end, error] = std::from_chars(rest_.data(), rest_.data() + rest_.size(), count);
      if (error != std::errc{} || out.size() == most_dimensions) return false;
      rest_.remove_prefix(static_cast<std::size_t>(end - rest_.data()));
      out.push_back(count);
      if (!take(",")) return take(")");
    }
    return true;
  }

  bool take_count_or_shape(std::vector<std::uint64_t>& out) {
    skip_blanks();
    if (rest_.starts_with('(')) return take_shape(out);
    if (rest_.starts_with(')')) return true;
    std::uint64_t count = 0;
    const auto [end, error] = std::from_chars(rest_.data(), rest_.data() + rest_.size(), count);
    if (error != std::errc{}) return false;
    rest_.remove_prefix(static_cast<std::size_t>(end - rest_.data()));
    out.push_back(count);
    return true;
  }

  bool at_end() {
    skip_blanks();
    return rest_.empty();
  }

 private:
  void skip_blanks() {
    rest_.remove_prefix(std::min(rest_.find_first_not_of(" \t\r\n"), rest_.size()));
  }

  std::string_view rest_;
};

/// Where the header's dict lies in the file.
struct HeaderLayout {
  std::size_t dict, end;
};

/// Bytes before the dict: the magic string, the version, and the dict's length in 2 or 4 bytes.
constexpr std::string_view magic("\x93NUMPY", 6);
constexpr std::size_t fixed_start = magic.size() + 2, longest_start = fixed_start + 4;

/// From the first bytes of a file of `file_size` bytes, all or at least `longest_start` of them.
Result<HeaderLayout> find_layout(std::string_view bytes, std::uint64_t file_size) {
  if (!bytes.starts_with(magic)) return broken("it does not begin with \\x93NUMPY");
  const auto byte = [&](std::size_t i) {
    return i < bytes.size() ? static_cast<unsigned char>(bytes[i]) : 0U;
  };
  if (byte(6) < 1 || byte(6) > 3 || byte(7) != 0) {
    return broken("its format version is " + std::to_string(byte(6)) + "." +
                  std::to_string(byte(7)) + ", expected 1.0, 2.0 or 3.0");
  }
  const std::size_t length_bytes = byte(6) == 1 ? 2 : 4, dict = fixed_start + length_bytes;
  std::uint64_t length = 0;
  for (std::size_t i = length_bytes; i-- > 0;) length = length << 8 | byte(fixed_start + i);
  if (dict > bytes.size() || length > file_size - dict) return broken("it ends within its header");
  if (length > largest_header) return broken("its header is longer than 65536 bytes");
  return HeaderLayout{dict, dict + static_cast<std::size_t>(length)};
}

}  // namespace

Result<NpyHeader> parse_npy_dict(std::string_view text) {
  NpyHeader header;
  LiteralReader reader(text);
  bool has_descr = false, has_order = false, has_shape = false;
  if (!reader.take("{")) return broken("its header is no dict");
  for (bool more = true; more && !reader.take("}");) {
    std::string key;
    if (!reader.take_string(key) || !reader.take(":")) return broken("a key was expected");
    bool* seen = key == "descr"           ? &has_descr
                 : key == "fortran_order" ? &has_order
                 : key == "shape"         ? &has_shape
                                          : nullptr;
    if (seen == nullptr) return broken("unknown header key " + quote(key));
    if (*seen) return broken("header key " + quote(key) + " is given twice");
    *seen = seen == &has_descr   ? reader.take_type(header)
            : seen == &has_order ? reader.take_boolean(header.fortran_order)
                                 : reader.take_shape(header.shape);
    if (!*seen) return broken("header key " + quote(key) + " has an unexpected value");
    more = reader.take(",");
    if (!more && !reader.take("}")) return broken("a ',' or '}' was expected");
  }
  if (!has_descr || !has_order || !has_shape) {
    return broken("its header lacks 'descr', 'fortran_order' or 'shape'");
  }
  if (!reader.at_end()) return broken("text follows the header's dict");
  return header;
}

Result<NpyHeader> parse_npy_header(std::string_view bytes) {
  const auto layout = find_layout(bytes, bytes.size());
  if (!layout) return layout.error();
  const auto [dict, end] = layout.value();
  auto header = parse_npy_dict(bytes.substr(dict, end - dict));
  if (header) header.value().size = end;
  return header;
}

Result<NpyHeader> read_npy_header(InputFile& file) {
  std::string bytes(longest_start, '\0');
  const auto start = file.read(bytes.data(), bytes.size());
  if (!start) return start.error();
  bytes.resize(start.value());
  const auto layout = find_layout(bytes, file.size());
  if (!layout) return layout.error();
  bytes.resize(std::max(layout.value().end, start.value()));
  const auto rest = file.read(bytes.data() + start.value(), bytes.size() - start.value());
  if (!rest) return rest.error();
  bytes.resize(start.value() + rest.value());
  return parse_npy_header(bytes);
}

}  // namespace boule
