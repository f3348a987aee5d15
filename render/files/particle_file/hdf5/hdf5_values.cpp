#include "render/files/particle_file/hdf5/hdf5_values.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cstdint>
#include <cstring>
#include <vector>

namespace boule::hdf5_module {
namespace {

herr_t take_first(unsigned, const H5E_error2_t* error, void* text) {
  if (error->desc != nullptr) *static_cast<std::string*>(text) = error->desc;
  return 1;  // the first is the innermost
}

bool is_truth(hid_t type) {
  if (H5Tget_nmembers(type) != 2) return false;
  for (const auto& [name, code] : {std::pair{"FALSE", 0}, std::pair{"TRUE", 1}}) {
    std::array<unsigned char, 16> value{};
    if (H5Tget_size(type) > value.size() || H5Tenum_valueof(type, name, value.data()) < 0)
      return false;
    if (std::count(value.begin(), value.end(), 0) != 16 - code) return false;
  }
  return true;
}

/// The number that an integer of memory is.
double number_of(const unsigned char* bytes, std::size_t size, bool is_signed) {
  std::uint64_t bits = 0;
  std::memcpy(&bits, bytes, size);
  const std::size_t unused = 64 - 8 * size;
  if (!is_signed) return static_cast<double>(bits);
  return static_cast<double>(static_cast<std::int64_t>(bits << unused) >> unused);
}
static_assert(std::endian::native == std::endian::little, "integers are read byte by byte");

}  // namespace

Failure failure() {
  std::string text;
  H5Ewalk2(H5E_DEFAULT, H5E_WALK_UPWARD, take_first, &text);
  return {"HDF5: " + (text.empty() ? "it fails" : text)};
}

Kind kind_of(hid_t type) {
  switch (H5Tget_class(type)) {
    case H5T_INTEGER:
      return Kind::integers;
    case H5T_FLOAT:
      return Kind::floats;
    case H5T_STRING:
      return Kind::texts;
    case H5T_ENUM:
      return is_truth(type) ? Kind::integers : Kind::codes;
    default:
      return Kind::other;
  }
}

/// Numbers that have names are not converted by the library.
void read_codes(const Source& source, double* to) {
  const Handle native(checked(H5Tget_native_type(source.type, H5T_DIR_ASCEND)));
  const Handle whole(checked(H5Tget_super(native.id())));
  const std::size_t size = H5Tget_size(native.id());
  const bool is_signed = H5Tget_sign(whole.id()) == H5T_SGN_2;
  if (size == 0 || size > sizeof(std::uint64_t)) throw Failure{"its numbers are too long"};
  std::vector<unsigned char> bytes(size * source.count);
  checked(source.read(native.id(), bytes.data()));
  for (std::size_t i = 0; i < source.count; ++i)
    to[i] = number_of(bytes.data() + i * size, size, is_signed);
}

void read_numbers(const Source& source, double* to) {
  if (H5Tget_class(source.type) == H5T_ENUM) return read_codes(source, to);
  checked(source.read(H5T_NATIVE_DOUBLE, to));
}

void read_texts(const Source& source, TakeText take, void* context) {
  if (checked(H5Tis_variable_str(source.type)) > 0) {
    const Handle type(checked(H5Tcopy(H5T_C_S1)));
    checked(H5Tset_size(type.id(), H5T_VARIABLE));
    checked(H5Tset_cset(type.id(), H5Tget_cset(source.type)));
    std::vector<char*> texts(source.count);
    checked(source.read(type.id(), texts.data()));
    for (const char* const text : texts)
      take(context, text, text == nullptr ? 0 : std::strlen(text));
    source.reclaim(type.id(), texts.data());
    return;
  }
  constexpr std::size_t most = std::size_t{1} << 30;
  const std::size_t size = H5Tget_size(source.type);
  if (size == 0 || size > most / std::max<std::size_t>(source.count, 1))
    throw Failure{"its texts are too long"};
  std::vector<char> bytes(size * source.count);
  checked(source.read(source.type, bytes.data()));
  for (std::size_t i = 0; i < source.count; ++i) {
    const char* const text = bytes.data() + i * size;
    take(context, text, strnlen(text, size));
  }
}

}  // namespace boule::hdf5_module
