#include "render/files/file/unpack.h"

#include <algorithm>
#include <array>
#include <cstdint>
#include <limits>
#include <string>
#include <utility>

#include "render/memory/available_memory.h"

#ifdef BOULE_HAS_ZLIB
#include <zlib.h>
#endif
#ifdef BOULE_HAS_ZSTD
#include <zstd.h>
#endif
#ifdef BOULE_HAS_BZ2
#include <bzlib.h>
#endif
#ifdef BOULE_HAS_LZMA
#include <lzma.h>
#endif

namespace boule {
namespace {

bool only_zeros(std::string_view rest) {
  return rest.find_first_not_of('\0') == std::string_view::npos;
}

Diagnostic damaged(const std::string& packer, const std::string& reason) {
  return Diagnostic::of("its " + packer + " data are damaged: " + reason);
}

/// What one step of an unpacker came to.
struct Step {
  bool ended = false;           ///< the member, behind which the next one begins
  const char* error = nullptr;  ///< what is wrong with the data
};

/// How much of what waits and of the room a library is given at once: some count in 32 bits.
constexpr std::size_t most = std::size_t{1} << 30;

/// Gives a library's stream, which has zlib's members, the bytes that wait and the room for what
/// they hold, steps, and takes note of what it has used.
template <class Byte, class Stream, class Function>
auto step_with(Stream& stream, std::string_view& rest, GrowingBytes& text, Function function) {
  const std::size_t in = std::min(most, rest.size());
  const std::size_t out = std::min(most, text.capacity() - text.size());
  // No library writes to its input.
  stream.next_in = reinterpret_cast<Byte*>(const_cast<char*>(rest.data()));
  stream.avail_in = static_cast<decltype(stream.avail_in)>(in);
  stream.next_out = reinterpret_cast<Byte*>(text.data() + text.size());
  stream.avail_out = static_cast<decltype(stream.avail_out)>(out);
  const auto answer = function(&stream);
  rest.remove_prefix(in - stream.avail_in);
  text.set_size(text.size() + (out - stream.avail_out));
  return answer;
}

/// All members. An unpacker has a name; begin(), before each of them; step().
template <class Unpacker>
Result<Unpacked> unpack_by(std::string_view rest) {
  Unpacker unpacker;
  Unpacked done;
  do {
    if (auto begun = unpacker.begin(rest, done.bytes); !begun) return begun.error();
    for (bool ended = false; !ended;) {
      if (done.bytes.size() == done.bytes.capacity()) {
        if (auto grown = done.bytes.grow(); !grown) return grown.error();
      }
      const Step step = unpacker.step(rest, done.bytes);
      if (step.error != nullptr) return damaged(Unpacker::name, step.error);
      ended = step.ended;
      if (!ended && rest.empty() && done.bytes.size() < done.bytes.capacity()) {
        done.whole = damaged(Unpacker::name, "the file ends before them");
        return done;
      }
    }
  } while (!only_zeros(rest));
  return done;
}

[[maybe_unused]] Diagnostic without(const std::string& packer, const std::string& library,
                                    const std::string& package) {
  return Diagnostic::of("it is packed by " + packer +
                        ", and this build cannot unpack it: it was made without " + library +
                        " (package " + package + ")");
}

#ifdef BOULE_HAS_ZLIB
class GzipUnpacker {
 public:
  static constexpr const char* name = "gzip";
  GzipUnpacker() = default;
  GzipUnpacker(const GzipUnpacker&) = delete;
  GzipUnpacker& operator=(const GzipUnpacker&) = delete;
  ~GzipUnpacker() { inflateEnd(&stream_); }

  Status begin(std::string_view, GrowingBytes&) {
    constexpr int gzip_only = 16 + MAX_WBITS;
    const bool is_first = stream_.state == nullptr;
    const int answer = is_first ? inflateInit2(&stream_, gzip_only) : inflateReset(&stream_);
    return answer == Z_OK ? Status() : Diagnostic::of("zlib has no memory");
  }

  Step step(std::string_view& rest, GrowingBytes& text) {
    const int answer =
        step_with<Bytef>(stream_, rest, text, [](z_stream* s) { return inflate(s, Z_NO_FLUSH); });
    if (answer == Z_OK || answer == Z_BUF_ERROR) return {};
    if (answer == Z_STREAM_END) return {true};
    return {false, stream_.msg != nullptr ? stream_.msg : "not what zlib expected"};
  }

 private:
  z_stream stream_ = {};
};
#endif

#ifdef BOULE_HAS_ZSTD
class ZstandardUnpacker {
 public:
  static constexpr const char* name = "Zstandard";
  ZstandardUnpacker() : stream_(ZSTD_createDStream()) {}
  ZstandardUnpacker(const ZstandardUnpacker&) = delete;
  ZstandardUnpacker& operator=(const ZstandardUnpacker&) = delete;
  ~ZstandardUnpacker() { ZSTD_freeDStream(stream_); }

  /// Room for a frame that tells its length. One that lies is refused here, or finds too much room.
  Status begin(std::string_view rest, GrowingBytes& text) {
    if (stream_ == nullptr) return Diagnostic::of("Zstandard has no memory");
    const unsigned long long length = ZSTD_getFrameContentSize(rest.data(), rest.size());
    if (length == ZSTD_CONTENTSIZE_UNKNOWN || length == ZSTD_CONTENTSIZE_ERROR) return {};
    if (length > std::numeric_limits<std::size_t>::max() / 2)
      return damaged(name, "no text is as long as they say");
    const std::size_t needed = text.size() + static_cast<std::size_t>(length);
    // Many small frames must not move the bytes each time.
    const bool is_small = text.size() > 0 && needed - text.size() < text.size() / 2;
    return needed > text.capacity() && is_small ? text.grow() : text.reserve(needed);
  }

  Step step(std::string_view& rest, GrowingBytes& text) {
    ZSTD_inBuffer in = {rest.data(), rest.size(), 0};
    ZSTD_outBuffer out = {text.data(), text.capacity(), text.size()};
    const std::size_t answer = ZSTD_decompressStream(stream_, &out, &in);
    rest.remove_prefix(in.pos);
    text.set_size(out.pos);
    if (ZSTD_isError(answer) != 0) return {false, ZSTD_getErrorName(answer)};
    return {answer == 0};
  }

 private:
  ZSTD_DStream* const stream_;
};
#endif

#ifdef BOULE_HAS_BZ2
class Bzip2Unpacker {
 public:
  static constexpr const char* name = "bzip2";
  Bzip2Unpacker() = default;
  Bzip2Unpacker(const Bzip2Unpacker&) = delete;
  Bzip2Unpacker& operator=(const Bzip2Unpacker&) = delete;
  ~Bzip2Unpacker() { BZ2_bzDecompressEnd(&stream_); }

  Status begin(std::string_view, GrowingBytes&) {
    BZ2_bzDecompressEnd(&stream_);
    stream_ = {};
    const int answer = BZ2_bzDecompressInit(&stream_, 0, 0);
    return answer == BZ_OK ? Status() : Diagnostic::of("bzip2 has no memory");
  }

  Step step(std::string_view& rest, GrowingBytes& text) {
    const int answer = step_with<char>(stream_, rest, text, &BZ2_bzDecompress);
    if (answer == BZ_OK) return {};
    if (answer == BZ_STREAM_END) return {true};
    return {false, answer == BZ_MEM_ERROR ? "memory does not suffice" : "not what bzip2 expected"};
  }

 private:
  bz_stream stream_ = {};
};
#endif

#ifdef BOULE_HAS_LZMA
class XzUnpacker {
 public:
  static constexpr const char* name = "xz";
  XzUnpacker() = default;
  XzUnpacker(const XzUnpacker&) = delete;
  XzUnpacker& operator=(const XzUnpacker&) = delete;
  ~XzUnpacker() { lzma_end(&stream_); }

  Status begin(std::string_view, GrowingBytes&) {
    const lzma_ret answer = lzma_stream_decoder(&stream_, available_memory(), 0);
    return answer == LZMA_OK ? Status() : Diagnostic::of("liblzma has no memory");
  }

  Step step(std::string_view& rest, GrowingBytes& text) {
    const lzma_ret answer = step_with<std::uint8_t>(
        stream_, rest, text, [](lzma_stream* s) { return lzma_code(s, LZMA_RUN); });
    switch (answer) {
      case LZMA_OK:
      case LZMA_BUF_ERROR:
        return {};
      case LZMA_STREAM_END:
        return {true};
      case LZMA_MEM_ERROR:
      case LZMA_MEMLIMIT_ERROR:
        return {false, "memory does not suffice for what they say"};
      default:
        return {false, "not what liblzma expected"};
    }
  }

 private:
  lzma_stream stream_ = LZMA_STREAM_INIT;
};
#endif

}  // namespace

Packing packing_of(std::string_view bytes) {
  using std::literals::operator""sv;
  if (bytes.starts_with("\x1f\x8b\x08"sv)) return Packing::gzip;
  if (bytes.starts_with("\x28\xb5\x2f\xfd"sv)) return Packing::zstandard;
  if (bytes.starts_with("BZh"sv)) return Packing::bzip2;
  if (bytes.starts_with("\xfd\x37zXZ\0"sv)) return Packing::xz;
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
  constexpr std::array others{Other{"\x5d\0\0"sv, "LZMA", "unlzma"},
                              Other{"\x04\x22\x4d\x18"sv, "LZ4", "unlz4"},
                              Other{"\x1f\x9d"sv, "compress", "uncompress"},
                              Other{"7z\xbc\xaf\x27\x1c"sv, "7-Zip", "7z x"}};
  for (const Other& other : others) {
    if (!bytes.starts_with(other.start)) continue;
    if (bytes.substr(1).starts_with("\0\0\0\0"sv)) continue;  // a number that fills 8 bytes
    return Diagnostic::of("it is packed by " + std::string(other.name) +
                          ", which is not read; unpack it first (" + std::string(other.program) +
                          "), or pack it by gzip or zstd");
  }
  return {};
}

Result<Unpacked> unpack(Packing packing, [[maybe_unused]] std::string_view packed) {
  switch (packing) {
    case Packing::none:
      break;
    case Packing::gzip:
#ifdef BOULE_HAS_ZLIB
      return unpack_by<GzipUnpacker>(packed);
#else
      return without("gzip", "zlib", "zlib1g-dev");
#endif
    case Packing::zstandard:
#ifdef BOULE_HAS_ZSTD
      return unpack_by<ZstandardUnpacker>(packed);
#else
      return without("Zstandard", "libzstd", "libzstd-dev");
#endif
    case Packing::bzip2:
#ifdef BOULE_HAS_BZ2
      return unpack_by<Bzip2Unpacker>(packed);
#else
      return without("bzip2", "libbz2", "libbz2-dev");
#endif
    case Packing::xz:
#ifdef BOULE_HAS_LZMA
      return unpack_by<XzUnpacker>(packed);
#else
      return without("xz", "liblzma", "liblzma-dev");
#endif
  }
  return Diagnostic::of("it is not packed");
}

}  // namespace boule
