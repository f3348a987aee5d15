#include "render/scene_file/npy_header.h"

#include <algorithm>
#include <charconv>
#include <cstddef>
#include <system_error>

namespace boule {
namespace {

constexpr std::size_t most_dimensions = 8;
/// NumPy's own headers are 128 bytes; its readers refuse more than 10,000 by default.
constexpr std::uint64_t largest_header = 65536;

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
    *seen = seen == &has_descr   ? reader.take_string(header.descr)
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

Result<NpyHeader> read_npy_header(InputFile& file) {
  unsigned char start[12] = {};
  const auto got = file.read(start, 8);
  if (!got) return got.error();
  const std::string_view magic("\x93NUMPY", 6);
  const bool is_npy = got.value() == 8 &&
                      std::equal(magic.begin(), magic.end(), start, [](char a, unsigned char b) {
                        return static_cast<unsigned char>(a) == b;
                      });
  if (!is_npy) return broken("it does not begin with \\x93NUMPY");
  if (start[6] < 1 || start[6] > 3 || start[7] != 0) {
    return broken("its format version is " + std::to_string(start[6]) + "." +
                  std::to_string(start[7]) + ", expected 1.0, 2.0 or 3.0");
  }
  const std::size_t length_bytes = start[6] == 1 ? 2 : 4;
  const auto more = file.read(start + 8, length_bytes);
  if (!more) return more.error();
  std::uint64_t length = 0;
  for (std::size_t i = length_bytes; i-- > 0;) length = length << 8 | start[8 + i];
  const std::uint64_t before = 8 + length_bytes;
  if (more.value() < length_bytes || length > file.size() || before > file.size() - length) {
    return broken("it ends within its header");
  }
  if (length > largest_header) return broken("its header is longer than 65536 bytes");
  std::string text(static_cast<std::size_t>(length), '\0');
  const auto read = file.read(text.data(), text.size());
  if (!read) return read.error();
  auto header = parse_npy_dict(std::string_view(text).substr(0, read.value()));
  if (header) header.value().size = before + length;
  return header;
}

}  // namespace boule
