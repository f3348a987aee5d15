#pragma once

#include <cstddef>
#include <cstdint>

/// The interface between the library and boule_mpi_NAME.so, the module that uses an MPI. Only plain
/// structs and function pointers cross it. All functions are called by one thread.
namespace boule::mpi_module {

/// Both change with any change of this file. The mark stands in the module's file, so the loader
/// can refuse a module of another version before any of it has run.
inline constexpr std::uint32_t version = 1;
inline constexpr char version_mark[] = "boule MPI module, version 1.";

/// The module's one exported symbol: `const Table* boule_mpi_module()`.
inline constexpr const char* entry_point = "boule_mpi_module";

/// A letter that came in. `bytes` is valid until the next call of receive().
struct Letter {
  int from;
  const char* bytes;
  std::size_t count;
};

struct Table {
  std::uint32_t version;
  /// Joins the processes that the launcher started: which of how many this is. False if MPI cannot.
  bool (*start)(int* rank, int* size);
  /// Sends a copy of the bytes, at most 2^30, and does not wait for it to arrive.
  void (*send)(int to, const char* bytes, std::size_t count);
  /// Takes a letter, if one has come: false if not.
  bool (*receive)(Letter* letter);
  /// Whether all letters of this process have left.
  bool (*idle)();
  /// Leaves in order, together with all others.
  void (*finish)();
  /// Ends all processes at once, this one among them.
  void (*end_all)(int code);
};

}  // namespace boule::mpi_module
