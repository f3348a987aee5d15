#include "render/files/file/npz_member.h"

#ifdef BOULE_HAS_LIBZIP
#include <zip.h>

#include <cstdint>
#include <memory>

#include "render/files/file/input_file.h"
#include "render/memory/available_memory.h"
#endif

namespace boule {

std::optional<NpzName> npz_name(const std::string& path) {
  constexpr std::string_view ending = ".npz";
  if (path.ends_with(ending)) return NpzName{path, ""};
  const std::size_t colon = path.rfind(':');
  if (colon == std::string::npos || !path.substr(0, colon).ends_with(ending)) return std::nullopt;
  return NpzName{path.substr(0, colon), path.substr(colon + 1)};
}

#ifndef BOULE_HAS_LIBZIP

Result<std::string> read_npz_array(const NpzName& name) {
  return Diagnostic::in_file(name.file,
                             "this build reads no .npz files: it was made without libzip "
                             "(Debian: libzip-dev)");
}

#else

namespace {

struct CloseArchive {
  void operator()(zip_t* archive) const { zip_discard(archive); }
};
struct CloseMember {
  void operator()(zip_file_t* member) const { zip_fclose(member); }
};
using Archive = std::unique_ptr<zip_t, CloseArchive>;
using Member = std::unique_ptr<zip_file_t, CloseMember>;

Result<Archive> open_archive(const std::string& path) {
  // Says what is no regular file, and what the system refuses, in the words of all readers.
  if (const auto file = InputFile::open(path); !file) return file.error();
  int code = 0;
  Archive archive(zip_open(path.c_str(), ZIP_RDONLY, &code));
  if (archive) return archive;
  zip_error_t error;
  zip_error_init_with_code(&error, code);
  std::string words = zip_error_strerror(&error);
  zip_error_fini(&error);
  return Diagnostic::in_file(path, "not a readable .npz file: " + words);
}

/// The names of the arrays, for messages.
std::string array_names(zip_t* archive) {
  constexpr zip_int64_t most = 20;
  std::string names;
  const zip_int64_t count = zip_get_num_entries(archive, 0);
  for (zip_int64_t i = 0; i < count && i < most; ++i) {
    const char* const found = zip_get_name(archive, static_cast<zip_uint64_t>(i), 0);
    std::string name = found == nullptr ? "" : found;
    if (name.ends_with(".npy")) name.resize(name.size() - 4);
    names += (names.empty() ? "" : ", ") + quote(name);
  }
  return names + (count > most ? " and more" : "");
}

/// The number of the array in its archive, or what is wrong.
Result<zip_uint64_t> find_array(zip_t* archive, const NpzName& name) {
  const zip_int64_t count = zip_get_num_entries(archive, 0);
  if (name.array.empty() && count == 1) return zip_uint64_t{0};
  if (name.array.empty()) {
    return Diagnostic::in_file(name.file, "holds " + std::to_string(count) +
                                              " arrays, name one as " + quote(name.file + ":NAME") +
                                              ": " + array_names(archive));
  }
  for (const std::string& member : {name.array + ".npy", name.array}) {
    const zip_int64_t found = zip_name_locate(archive, member.c_str(), 0);
    if (found >= 0) return static_cast<zip_uint64_t>(found);
  }
  return Diagnostic::in_file(
      name.file, "has no array " + quote(name.array) + ", it has " + array_names(archive));
}

}  // namespace

Result<std::string> read_npz_array(const NpzName& name) {
  const std::string shown = name.array.empty() ? "its array" : "the array " + quote(name.array);
  const auto archive = open_archive(name.file);
  if (!archive) return archive.error();
  const auto index = find_array(archive.value().get(), name);
  if (!index) return index.error();
  zip_stat_t stat;
  zip_stat_init(&stat);
  const auto unreadable = [&] {
    return Diagnostic::in_file(
        name.file, std::string("cannot be read: ") + zip_strerror(archive.value().get()));
  };
  if (zip_stat_index(archive.value().get(), index.value(), 0, &stat) != 0) return unreadable();
  if (auto done = check_memory(stat.size, shown + " needs"); !done) {
    done.error().file = name.file;
    return done.error();
  }
  const Member member(zip_fopen_index(archive.value().get(), index.value(), 0));
  if (!member) return unreadable();
  std::string bytes(static_cast<std::size_t>(stat.size), '\0');
  const zip_int64_t got = zip_fread(member.get(), bytes.data(), stat.size);
  // The checksum is compared only where the reading meets the end.
  char beyond = 0;
  const bool ends_well = zip_fread(member.get(), &beyond, 1) == 0;
  if (!ends_well || got < 0 || static_cast<zip_uint64_t>(got) != stat.size) {
    return Diagnostic::in_file(
        name.file, "is damaged: " + shown + " ends early or does not match its checksum");
  }
  return bytes;
}

#endif

}  // namespace boule
