#pragma once

#include <cstddef>
#include <cstdint>

/// The interface between the library and boule_hdf5.so, the module that uses libhdf5. Only plain
/// structs and function pointers cross it. Functions may be called by any thread. Paths are those
/// of objects within a file, such as "particles/all".
namespace boule::hdf5_module {

/// Both change with any change of this file. The mark stands in the module's file, so the loader
/// can refuse a module of another version before any of it has run.
inline constexpr std::uint32_t version = 1;
inline constexpr char version_mark[] = "boule HDF5 module, version 1.";

/// The module's one exported symbol: `const Table* boule_hdf5_module()`.
inline constexpr const char* entry_point = "boule_hdf5_module";

/// What a path leads to. `refused`: to something that is not read, for the reason that error() has.
/// `codes`: whole numbers that have names. `other`: what is none of these.
enum class Kind : std::uint32_t { none, group, integers, floats, codes, texts, other, refused };

inline constexpr std::size_t most_axes = 4;

struct Object {
  Kind kind;
  std::uint32_t axes;  ///< of a dataset
  std::uint64_t extent[most_axes];
  std::uint64_t chunk_bytes;  ///< what is read and unpacked at a time; 0: any number
};

/// A file and its last error.
struct File;

using TakeNumber = void (*)(void* context, double number);
using TakeText = void (*)(void* context, const char* bytes, std::size_t count);
using TakeName = void (*)(void* context, double code, const char* name);

/// Functions that return false leave their reason to error(). A callback may throw std::bad_alloc
/// alone.
struct Table {
  std::uint32_t version;
  const char* (*library)();  ///< "HDF5 1.10.8"
  /// Null only if there is no memory; else whether it is open, error() tells: it is empty then.
  File* (*open)(const char* path);
  void (*close)(File* file);
  const char* (*error)(const File* file);
  /// The names in a group, in the order of their making if that is kept, else in that of bytes.
  bool (*list)(File* file, const char* group, TakeText take, void* context);
  bool (*look)(File* file, const char* path, Object* object);
  /// The numbers or texts of an attribute, one by one; none if it is not there.
  bool (*attribute)(File* file, const char* path, const char* name, TakeNumber number,
                    TakeText text, void* context);
  /// The names of a dataset's codes.
  bool (*names)(File* file, const char* path, TakeName take, void* context);
  /// A part of a dataset: numbers or codes, the last axis runs fastest.
  bool (*read)(File* file, const char* path, const std::uint64_t* start, const std::uint64_t* count,
               double* to);
  /// The same of texts, one by one.
  bool (*read_texts)(File* file, const char* path, const std::uint64_t* start,
                     const std::uint64_t* count, TakeText take, void* context);
};

}  // namespace boule::hdf5_module
