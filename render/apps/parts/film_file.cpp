#include "render/apps/parts/film_file.h"

#include <cstdint>
#include <cstring>
#include <new>
#include <string_view>
#include <utility>

#include "render/files/file/byte_fields.h"
#include "render/files/file/checksum.h"
#include "render/files/file/input_file.h"
#include "render/image/output_file.h"

namespace boule::film_file {
namespace {

constexpr char magic[8] = {'b', 'o', 'u', 'l', 'f', 'i', 'l', 'm'};
constexpr std::uint32_t format_version = 4;
constexpr std::uint32_t transparent_flag = 1, outline_flag = 2, measured_flag = 4;
constexpr std::uint32_t order_shift = 8, order_mask = 3;  // the order is a number of the flags
static_assert(names<PixelOrder>.size() == order_mask + 1);

/// The numbers of a file's head, as they stand in it.
struct Numbers {
  char magic[8];
  std::uint32_t version, text_bytes;
  std::uint64_t blocks;
  std::int32_t frame_width, frame_height;
  PixelRect rect;
  std::int32_t spp;
  std::uint32_t flags, aovs;
  std::uint32_t pixel_bytes;
};
static_assert(sizeof(Numbers) == 64 && sizeof(PixelRect) == 16);

std::uint32_t bits_of(const AovSelection& aovs) {
  std::uint32_t bits = 0;
  for (std::size_t i = 0; i < aov_names.size(); ++i) {
    if (aovs.*aov_names[i].wanted) bits |= 1u << i;
  }
  return bits;
}

AovSelection aovs_of(std::uint32_t bits) {
  AovSelection aovs;
  for (std::size_t i = 0; i < aov_names.size(); ++i)
    aovs.*aov_names[i].wanted = (bits >> i & 1) != 0;
  return aovs;
}

Numbers numbers_of(const FilmHead& head, std::size_t text_bytes) {
  Numbers n{};
  std::memcpy(n.magic, magic, sizeof magic);
  n.version = format_version;
  n.text_bytes = static_cast<std::uint32_t>(text_bytes);
  n.blocks = head.blocks.size();
  n.frame_width = head.frame_width;
  n.frame_height = head.frame_height;
  n.rect = head.rect;
  n.spp = head.spp;
  n.flags = (head.transparent ? transparent_flag : 0) | (head.kinds.outline ? outline_flag : 0) |
            (head.kinds.measured ? measured_flag : 0) |
            static_cast<std::uint32_t>(head.order) << order_shift;
  n.aovs = bits_of(head.kinds.aovs);
  n.pixel_bytes = static_cast<std::uint32_t>(head.kinds.pixel_bytes());
  return n;
}

template <class T>
std::string_view bytes_of_values(const T* values, std::size_t count) {
  return {reinterpret_cast<const char*>(values), count * sizeof(T)};
}

/// Writes bytes and counts them into the checksum.
class Writer {
 public:
  Writer(OutputFile& file, const std::function<bool()>& stop) : file_(file), stop_(stop) {}

  Status write(std::string_view bytes) {
    if (stop_ && stop_()) return Diagnostic::of("interrupted");
    sum_.add(bytes);
    return file_.write(bytes.data(), bytes.size());
  }
  Status end() {
    const std::uint64_t sum = sum_.value();
    return file_.write(&sum, sizeof sum);
  }

 private:
  OutputFile& file_;
  const std::function<bool()>& stop_;
  Checksum sum_;
};

/// The blocks in pieces of about a MiB.
Status write_parts(Writer& writer, const FilmHead& head, const PartSheet& sheet) {
  constexpr std::size_t piece = 1 << 20;
  std::string text;
  for (const PixelRect& block : head.blocks) {
    sheet.append(block, text);
    if (text.size() < piece) continue;
    if (auto done = writer.write(text); !done) return done;
    text.clear();
  }
  return writer.write(text);
}

Status write_all(OutputFile& file, const FilmHead& head, const PartSheet& sheet,
                 const std::function<bool()>& stop) {
  const std::string text = ByteWriter().put(head.facts, head.share, head.metadata).take();
  const Numbers numbers = numbers_of(head, text.size());
  Writer writer(file, stop);
  if (auto done = writer.write(bytes_of_values(&numbers, 1)); !done) return done;
  if (auto done = writer.write(text); !done) return done;
  if (auto done = writer.write(bytes_of_values(head.blocks.data(), head.blocks.size())); !done)
    return done;
  if (auto done = write_parts(writer, head, sheet); !done) return done;
  return writer.end();
}

Result<std::string> all_bytes(const std::string& path) {
  auto file = InputFile::open(path);
  if (!file) return file.error();
  std::string bytes(static_cast<std::size_t>(file.value().size()), '\0');
  const auto count = file.value().read(bytes.data(), bytes.size());
  if (!count) return count.error();
  bytes.resize(count.value());
  return bytes;
}

/// Whether the numbers can be those of a picture.
bool are_possible(const Numbers& n) {
  const PixelRect frame{0, 0, n.frame_width, n.frame_height};
  constexpr int longest = 65535;
  return n.frame_width > 0 && n.frame_height > 0 && n.frame_width <= longest &&
         n.frame_height <= longest && !n.rect.empty() && contains(frame, n.rect) && n.spp > 0;
}

/// The bytes that a file with this head has, about if that is more than `most`; 0 if a block cannot
/// be.
std::uint64_t expected_bytes(const Numbers& n, const std::vector<PixelRect>& blocks,
                             std::uint64_t most) {
  std::uint64_t pixels = 0;
  for (const PixelRect& block : blocks) {
    if (block.empty() || !contains(n.rect, block)) return 0;
    if (pixels <= most) pixels += block.area();
  }
  return sizeof n + n.text_bytes + n.blocks * sizeof(PixelRect) + pixels * n.pixel_bytes +
         sizeof(std::uint64_t);
}

bool has_right_sum(std::string_view all) {
  std::uint64_t sum = 0;
  const std::string_view summed = all.substr(0, all.size() - sizeof sum);
  std::memcpy(&sum, all.data() + summed.size(), sizeof sum);
  Checksum real;
  real.add(summed);
  return real.value() == sum;
}

bool read_texts(std::string_view bytes, FilmHead& head) {
  ByteReader reader(bytes);
  reader.read(head.facts);
  reader.read(head.share);
  reader.read(head.metadata);
  return reader.finished();
}

}  // namespace

Status check_support() {
  if (Checksum::available()) return {};
  return Diagnostic::of("this boule was built without xxhash.h, which film files need");
}

Status write(const std::string& path, const FilmHead& head, const PartSheet& sheet,
             const std::function<bool()>& stop) {
  if (auto done = check_support(); !done) return done;
  try {
    auto file = OutputFile::create(path, stop);
    if (!file) return file.error();
    if (auto done = write_all(file.value(), head, sheet, stop); !done) return done;
    return file.value().commit(stop);
  } catch (const std::bad_alloc&) {
    return cannot_write(path, "out of memory");
  }
}

Result<Reader> Reader::open(const std::string& path) {
  if (auto done = check_support(); !done) return done.error();
  try {
    auto bytes = all_bytes(path);
    if (!bytes) return bytes.error();
    Reader reader;
    reader.path_ = path;
    reader.bytes_ = std::move(bytes).value();
    const std::string wrong = reader.parse();
    if (!wrong.empty()) return Diagnostic::in_file(path, wrong);
    return reader;
  } catch (const std::bad_alloc&) {
    return Diagnostic::in_file(path, "does not fit into memory");
  }
}

/// Fills head_ from bytes_. Returns what is wrong, or nothing.
std::string Reader::parse() {
  const std::string_view all = bytes_;
  Numbers n{};
  if (all.size() < sizeof n || all.substr(0, sizeof magic) != bytes_of_values(magic, sizeof magic))
    return "is no film file of boule, or cut off in its head";
  std::memcpy(&n, all.data(), sizeof n);
  if (n.version != format_version) {
    return "is a film file of version " + std::to_string(n.version) + ", expected " +
           std::to_string(format_version);
  }
  std::string cut_off = parse_blocks(n.text_bytes, n.blocks);
  if (!cut_off.empty()) return cut_off;
  const char* const changed = "was changed: its checksum is wrong";
  head_.kinds = {(n.flags & outline_flag) != 0, aovs_of(n.aovs), (n.flags & measured_flag) != 0};
  if (!are_possible(n) || n.pixel_bytes != head_.kinds.pixel_bytes()) return changed;
  const std::uint64_t expected = expected_bytes(n, head_.blocks, all.size());
  if (expected > all.size()) {
    return "is cut off: it has " + std::to_string(all.size()) + " bytes of " +
           std::to_string(expected);
  }
  const bool whole = expected == all.size() && has_right_sum(all) &&
                     read_texts(all.substr(sizeof n, n.text_bytes), head_);
  if (!whole) return changed;
  head_.frame_width = n.frame_width;
  head_.frame_height = n.frame_height;
  head_.rect = n.rect;
  head_.spp = n.spp;
  head_.transparent = (n.flags & transparent_flag) != 0;
  head_.order = static_cast<PixelOrder>(n.flags >> order_shift & order_mask);
  return {};
}

std::string Reader::parse_blocks(std::uint64_t text_bytes, std::uint64_t blocks) {
  const std::uint64_t room = bytes_.size() - sizeof(Numbers);
  if (text_bytes > room || blocks > (room - text_bytes) / sizeof(PixelRect))
    return "is cut off in its head, or was changed";
  const std::size_t begin = sizeof(Numbers) + static_cast<std::size_t>(text_bytes);
  head_.blocks.resize(static_cast<std::size_t>(blocks));
  std::memcpy(head_.blocks.data(), bytes_.data() + begin, head_.blocks.size() * sizeof(PixelRect));
  parts_ = begin + head_.blocks.size() * sizeof(PixelRect);
  return {};
}

Status Reader::read(PartSheet& sheet) const {
  std::size_t at = parts_;
  for (const PixelRect& block : head_.blocks) {
    const auto count = static_cast<std::size_t>(block.area()) * head_.kinds.pixel_bytes();
    if (!sheet.take(block, std::string_view(bytes_).substr(at, count)))
      return Diagnostic::in_file(path_, "holds samples that cannot be");
    at += count;
  }
  return {};
}

}  // namespace boule::film_file
