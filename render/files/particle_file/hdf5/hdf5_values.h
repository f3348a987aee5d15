#pragma once

#include <hdf5.h>

#include <cstddef>
#include <functional>
#include <string>
#include <utility>

#include "render/files/particle_file/hdf5/hdf5_module.h"

/// Parts of the module: what the library gives, as numbers and texts.
namespace boule::hdf5_module {

/// Something of the library, closed with this object.
class Handle {
 public:
  explicit Handle(hid_t id) : id_(id) {}
  Handle(Handle&& other) noexcept : id_(other.release()) {}
  Handle& operator=(Handle&&) = delete;
  ~Handle() {
    if (id_ >= 0) H5Idec_ref(id_);
  }
  [[nodiscard]] hid_t id() const { return id_; }
  hid_t release() { return std::exchange(id_, H5I_INVALID_HID); }

 private:
  hid_t id_;
};

/// What is wrong, for the user: it is thrown within the module.
struct Failure {
  std::string text;
};

/// The library's own last error.
Failure failure();

/// What the library returned, if that is no error; else throws failure().
template <class T>
T checked(T value) {
  if (value < 0) throw failure();
  return value;
}

/// What values of a type are: one of the kinds of values.
Kind kind_of(hid_t type);

/// Bytes in memory as they are read. Both are of datasets or of attributes.
struct Source {
  hid_t type;  ///< in the file
  std::size_t count;
  std::function<herr_t(hid_t type, void* to)> read;
  std::function<void(hid_t type, void* texts)> reclaim;  ///< what variable texts take
};

/// Numbers: of integers, of floats, and of codes. Throws Failure, as do the next.
void read_numbers(const Source& source, double* to);
void read_codes(const Source& source, double* to);
void read_texts(const Source& source, TakeText take, void* context);

}  // namespace boule::hdf5_module
