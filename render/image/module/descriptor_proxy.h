#pragma once

#include <OpenImageIO/filesystem.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace boule::image_module {

/// Writes OpenImageIO's bytes to a file descriptor. It buffers them, because the PNM writer writes
/// single bytes. After a failure it keeps the errno code and claims success: otherwise libjpeg
/// would end the process, and other libraries would lose the reason. One thread at a time may use
/// it.
class DescriptorProxy final : public OIIO::Filesystem::IOProxy {
 public:
  explicit DescriptorProxy(int descriptor) : IOProxy("", Write), descriptor_(descriptor) {}

  const char* proxytype() const override { return "boule"; }
  void close() override {}
  size_t size() const override { return size_; }
  size_t write(const void* bytes, size_t count) override {
    const size_t written = pwrite(bytes, count, m_pos);
    m_pos += static_cast<int64_t>(written);
    return written;
  }
  size_t pwrite(const void* bytes, size_t count, int64_t offset) override {
    constexpr size_t enough = 1 << 16;
    const auto end = gathered_at_ + static_cast<int64_t>(gathered_.size());
    if (offset != end || gathered_.size() >= enough) {
      flush_gathered();
      gathered_at_ = offset;
    }
    const auto* from = static_cast<const char*>(bytes);
    gathered_.insert(gathered_.end(), from, from + count);
    size_ = std::max(size_, static_cast<size_t>(offset) + count);
    return count;
  }
  size_t read(void* bytes, size_t count) override {
    const size_t got = pread(bytes, count, m_pos);
    m_pos += static_cast<int64_t>(got);
    return got;
  }
  size_t pread(void* bytes, size_t count, int64_t offset) override {
    flush_gathered();
    const ssize_t got = ::pread(descriptor_, bytes, count, offset);
    return got < 0 ? 0 : static_cast<size_t>(got);
  }

  /// Writes the buffered bytes. Returns the errno code of the first failure so far, or 0.
  int finish() {
    flush_gathered();
    return code_;
  }

  /// The errno code of the first failure so far, or 0.
  [[nodiscard]] int code() const { return code_; }

 private:
  void flush_gathered() {
    for (size_t done = 0; done < gathered_.size() && code_ == 0;) {
      const ssize_t written =
          ::pwrite(descriptor_, gathered_.data() + done, gathered_.size() - done,
                   gathered_at_ + static_cast<int64_t>(done));
      if (written > 0) {
        done += static_cast<size_t>(written);
      } else if (written == 0 || errno != EINTR) {
        code_ = written == 0 ? EIO : errno;
      }
    }
    gathered_.clear();
  }

  int descriptor_;
  int code_ = 0;
  size_t size_ = 0;
  std::vector<char> gathered_;
  int64_t gathered_at_ = 0;
};

}  // namespace boule::image_module
