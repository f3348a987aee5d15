#include "render/files/file/unpack.h"

#include <algorithm>
#include <array>
#include <limits>
#include <memory>
#include <string>
#include <utility>

#ifdef BOULE_HAS_ZLIB
#include <zlib.h>
#endif
#ifdef BOULE_HAS_ZSTD
#include <zstd.h>
#endif

namespace boule {
namespace {

[[maybe_unused]] bool only_zeros(std::string_view rest) {
  return rest.find_first_not_of('\0') == std::string_view::npos;
}

[[maybe_unused]] Diagnostic damaged(const std::string& packer, const std::string& reason) {
  return Diagnostic::of("its " + packer + " data are damaged: " + reason);
}

#ifdef BOULE_HAS_ZLIB
class GzipUnpacker {
 public:
  explicit GzipUnpacker(std::string_view packed) : rest_(packed) {}
  GzipUnpacker(const GzipUnpacker&) = delete;
  GzipUnpacker& operator=(const GzipUnpacker&) = delete;
  ~GzipUnpacker() { inflateEnd(&stream_); }

  Status run() {
    constexpr int gzip_only = 16 + MAX_WBITS;
    if (inflateInit2(&stream_, gzip_only) != Z_OK) return Diagnostic::of("zlib has no memory");
    do {
      if (auto done = member(); !done) return done;
      inflateReset(&stream_);
    } while (whole_ && !only_zeros(rest_));
    return {};
  }

  Unpacked take() { return {std::move(text_), std::move(whole_)}; }

 private:
  /// Unpacks one member and leaves `rest_` at what follows it.
  Status member() {
    for (;;) {
      if (text_.size() == text_.capacity()) {
        if (auto grown = text_.grow(); !grown) return grown;
      }
      const int answer = step();
      if (answer == Z_STREAM_END) return {};
      if (answer == Z_BUF_ERROR && rest_.empty()) {
        whole_ = damaged("gzip", "the file ends before them");
        return {};
      }
      if (answer != Z_OK && answer != Z_BUF_ERROR) {
        return damaged("gzip", stream_.msg != nullptr ? stream_.msg : "not what zlib expected");
      }
    }
  }

  int step() {
    constexpr std::size_t most = std::size_t{1} << 30;  // zlib counts in 32 bits
    const std::size_t in = std::min(most, rest_.size());
    const std::size_t out = std::min(most, text_.capacity() - text_.size());
    // zlib does not write to its input.
    stream_.next_in = reinterpret_cast<Bytef*>(const_cast<char*>(rest_.data()));
    stream_.avail_in = static_cast<uInt>(in);
    stream_.next_out = reinterpret_cast<Bytef*>(text_.data() + text_.size());
    stream_.avail_out = static_cast<uInt>(out);
    const int answer = inflate(&stream_, Z_NO_FLUSH);
    rest_.remove_prefix(in - stream_.avail_in);
    text_.set_size(text_.size() + (out - stream_.avail_out));
    return answer;
  }

  std::string_view rest_;
  GrowingBytes text_;
  Status whole_;
  z_stream stream_ = {};
};

Result<Unpacked> unpack_gzip(std::string_view packed) {
  GzipUnpacker unpacker(packed);
  if (auto done = unpacker.run(); !done) return done.error();
  return unpacker.take();
}
#else
Result<Unpacked> unpack_gzip(std::string_view) {
  return Diagnostic::of(
      "it is packed by gzip, and this build cannot unpack it: it was made without zlib (package "
      "zlib1g-dev)");
}
#endif

#ifdef BOULE_HAS_ZSTD
/// Room for a frame that tells its length. One that lies is refused here, or finds too much room.
Status reserve_frame(std::string_view packed, GrowingBytes& text) {
  const unsigned long long length = ZSTD_getFrameContentSize(packed.data(), packed.size());
  if (length == ZSTD_CONTENTSIZE_UNKNOWN || length == ZSTD_CONTENTSIZE_ERROR) return {};
  if (length > std::numeric_limits<std::size_t>::max() / 2) {
    return damaged("Zstandard", "no text is as long as they say");
  }
  const std::size_t needed = text.size() + static_cast<std::size_t>(length);
  // Many small frames must not move the bytes each time.
  const bool is_small = text.size() > 0 && needed - text.size() < text.size() / 2;
  return needed > text.capacity() && is_small ? text.grow() : text.reserve(needed);
}

Result<Unpacked> unpack_zstandard(std::string_view packed) {
  const std::unique_ptr<ZSTD_DStream, decltype(&ZSTD_freeDStream)> stream(ZSTD_createDStream(),
                                                                          &ZSTD_freeDStream);
  if (stream == nullptr) return Diagnostic::of("Zstandard has no memory");
  GrowingBytes text;
  ZSTD_inBuffer in = {packed.data(), packed.size(), 0};
  std::size_t answer = 0;  // 0: between two frames
  for (;;) {
    const std::string_view rest = packed.substr(in.pos);
    if (answer == 0 && only_zeros(rest)) return Unpacked{std::move(text), {}};
    if (answer == 0) {
      if (auto room = reserve_frame(rest, text); !room) return room.error();
    }
    if (text.size() == text.capacity()) {
      if (auto grown = text.grow(); !grown) return grown.error();
    }
    ZSTD_outBuffer out = {text.data(), text.capacity(), text.size()};
    answer = ZSTD_decompressStream(stream.get(), &out, &in);
    if (ZSTD_isError(answer) != 0) return damaged("Zstandard", ZSTD_getErrorName(answer));
    text.set_size(out.pos);
    if (answer != 0 && rest.empty() && out.pos < out.size) {
      return Unpacked{std::move(text), damaged("Zstandard", "the file ends before them")};
    }
  }
}
#else
Result<Unpacked> unpack_zstandard(std::string_view) {
  return Diagnostic::of(
      "it is packed by Zstandard, and this build cannot unpack it: it was made without libzstd "
      "(package libzstd-dev)");
}
#endif

}  // namespace

Packing packing_of(std::string_view bytes) {
  using std::literals::operator""sv;
  if (bytes.starts_with("\x1f\x8b"sv)) return Packing::gzip;
  if (bytes.starts_with("\x28\xb5\x2f\xfd"sv)) return Packing::zstandard;
  // A frame to be skipped, as parallel packers write them in front.
  const bool skips = bytes.size() >= 4 && bytes.substr(1, 3) == "\x2a\x4d\x18"sv;
  const int first = bytes.empty() ? 0 : static_cast<unsigned char>(bytes.front());
  return skips && first >= 0x50 && first <= 0x5f ? Packing::zstandard : Packing::none;
}

Status check_packing(std::string_view bytes) {
  using std::literals::operator""sv;
  struct Other {
    std::string_view start, name, program;
  };
  constexpr std::array others{Other{"BZh"sv, "bzip2", "bunzip2"},
                              Other{"\xfd\x37zXZ\0"sv, "xz", "unxz"},
                              Other{"\x5d\0\0"sv, "LZMA", "unlzma"},
                              Other{"\x04\x22\x4d\x18"sv, "LZ4", "unlz4"},
                              Other{"\x1f\x9d"sv, "compress", "uncompress"},
                              Other{"7z\xbc\xaf\x27\x1c"sv, "7-Zip", "7z x"}};
  for (const Other& other : others) {
    if (!bytes.starts_with(other.start)) continue;
    return Diagnostic::of("it is packed by " + std::string(other.name) +
                          ", which is not read; unpack it first (" + std::string(other.program) +
                          "), or pack it by gzip or zstd");
  }
  return {};
}

Result<Unpacked> unpack(Packing packing, std::string_view packed) {
  return packing == Packing::gzip ? unpack_gzip(packed) : unpack_zstandard(packed);
}

}  // namespace boule
