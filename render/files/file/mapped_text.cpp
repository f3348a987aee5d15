#include "render/files/file/mapped_text.h"

#include <sys/mman.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstdint>
#include <limits>
#include <system_error>
#include <utility>

#include "render/files/file/input_file.h"
#include "render/files/file/unpack.h"
#include "render/memory/available_memory.h"

namespace boule {
namespace {

constexpr std::uint64_t largest_read = std::uint64_t{16} << 20;

Result<std::string> read_whole(InputFile& file, const std::string& path) {
  if (auto room = check_memory(file.size(), "it needs"); !room)
    return cannot_read(path, room.error().message);
  std::string text(static_cast<std::size_t>(file.size()), '\0');
  const auto got = file.read(text.data(), text.size());
  if (!got) return got.error();
  text.resize(got.value());
  return text;
}

std::string_view without_mark(std::string_view text) {
  if (text.starts_with("\xef\xbb\xbf")) text.remove_prefix(3);
  return text;
}

}  // namespace

void MappedText::Unmap::operator()(void* map) const { ::munmap(map, bytes); }

void MappedText::let_go(std::string_view part) const {
  if (map_ == nullptr) return;
  // The system maps more pages than the one that is asked for: some before this part were mapped
  // once more after they were let go.
  constexpr std::size_t around = std::size_t{2} << 20;
  char* const map = static_cast<char*>(map_.get());
  const auto page = static_cast<std::size_t>(::sysconf(_SC_PAGESIZE));
  const auto offset = static_cast<std::size_t>(part.data() - map);
  const std::size_t begin = (offset - std::min(offset, around)) / page * page;
  // Nothing was written to them: the system forgets where they are, and nothing else.
  ::madvise(map + begin, offset + part.size() - begin, MADV_DONTNEED);
}

MappedText MappedText::of(std::string text) {
  MappedText made;
  made.owned_ = std::make_unique<const std::string>(std::move(text));
  made.text_ = without_mark(*made.owned_);
  return made;
}

Result<MappedText> MappedText::open(const std::string& path, Cut cut) {
  auto file = InputFile::open(path);
  if (!file) return file.error();
  const std::uint64_t size = file.value().size();
  MappedText opened;
  std::string_view bytes;
  if (size <= largest_read) {
    auto text = read_whole(file.value(), path);
    if (!text) return text.error();
    opened.owned_ = std::make_unique<const std::string>(std::move(text).value());
    bytes = *opened.owned_;
  } else {
    if (size > address_room()) return cannot_read(path, "it is larger than the memory's limit");
    const auto length = static_cast<std::size_t>(size);
    void* const map = ::mmap(nullptr, length, PROT_READ, MAP_PRIVATE, file.value().descriptor(), 0);
    if (map == MAP_FAILED) return cannot_read(path, std::generic_category().message(errno));
    opened.map_ = std::unique_ptr<void, Unmap>(map, Unmap{length});
    bytes = {static_cast<const char*>(map), length};
  }
  opened.text_ = without_mark(bytes);
  const Packing packing = packing_of(bytes);
  if (packing == Packing::none) {
    if (const auto done = check_packing(bytes); !done)
      return cannot_read(path, done.error().message);
    return opened;
  }
  auto unpacked = unpack(packing, bytes);
  if (!unpacked) return cannot_read(path, unpacked.error().message);
  MappedText text;
  text.whole_ = std::move(unpacked.value().whole);
  if (!text.whole_ && cut == Cut::refuse) return cannot_read(path, text.whole_.error().message);
  text.unpacked_ = std::move(unpacked.value().bytes);
  text.text_ = without_mark({text.unpacked_.data(), text.unpacked_.size()});
  if (!text.whole_) text.text_ = text.text_.substr(0, text.text_.rfind('\n') + 1);  // npos + 1 is 0
  return text;
}

}  // namespace boule
