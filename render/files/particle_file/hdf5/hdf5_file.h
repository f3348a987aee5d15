#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <map>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "core/base/error.h"
#include "render/files/particle_file/hdf5/hdf5_module.h"

namespace boule {

/// What a path of a file of HDF5 leads to.
using Hdf5Object = hdf5_module::Object;
using Hdf5Kind = hdf5_module::Kind;

/// Where a part of a dataset begins, or how long it is, along each axis.
using Hdf5Extent = std::array<std::uint64_t, hdf5_module::most_axes>;

/// A file of HDF5, read by the module boule_hdf5.so, which is loaded on first use. Paths are those
/// of objects within it, "particles/all". Errors name the path.
class Hdf5File {
 public:
  /// An error without the module names the package of Debian.
  static Result<std::unique_ptr<Hdf5File>> open(const std::string& path);

  Hdf5File(const Hdf5File&) = delete;
  Hdf5File& operator=(const Hdf5File&) = delete;
  ~Hdf5File();

  /// "HDF5 1.10.8".
  [[nodiscard]] std::string library() const { return table_.library(); }

  /// What is there. What may not be read is of the kind `refused`; refusal() has the reason.
  [[nodiscard]] Hdf5Object look(const std::string& path) const;
  [[nodiscard]] bool has_group(const std::string& path) const;
  /// Why a path is not read that look() refuses.
  [[nodiscard]] Diagnostic refusal(const std::string& path) const;

  /// The names in a group, in their order; none if there is no such group.
  [[nodiscard]] Result<std::vector<std::string>> list(const std::string& group) const;

  /// The values of an attribute; none if it is not there, is of another kind or cannot be read.
  [[nodiscard]] std::vector<double> numbers_of(const std::string& path,
                                               const std::string& attribute) const;
  [[nodiscard]] std::vector<std::string> texts_of(const std::string& path,
                                                  const std::string& attribute) const;

  /// The names of a dataset's codes.
  [[nodiscard]] Result<std::map<double, std::string>> names_of(const std::string& path) const;

  /// Reads a part of a dataset of numbers or codes.
  Status read(const std::string& path, const Hdf5Extent& start, const Hdf5Extent& count,
              double* to) const;
  /// Reads a part of a dataset of texts: calls take(text) for each.
  Status read_texts(const std::string& path, const Hdf5Extent& start, const Hdf5Extent& count,
                    const std::function<void(std::string_view text)>& take) const;

 private:
  Hdf5File(const hdf5_module::Table& table, hdf5_module::File* file) : table_(table), file_(file) {}
  [[nodiscard]] Diagnostic error(const std::string& path) const;

  const hdf5_module::Table& table_;
  hdf5_module::File* file_;
};

}  // namespace boule
