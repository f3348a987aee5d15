#pragma once

#include <exception>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "core/base/error.h"
#include "render/image/band_writer.h"
#include "render/image/image_format.h"
#include "render/image/module/image_module.h"

namespace boule {

/// The input of the module for writing a picture: plain structs, and the data behind their
/// pointers.
struct ImagePlan {
  ImageForm form;
  std::vector<image_module::Channel> channels;
  Metadata metadata;
  std::vector<image_module::Attribute> attributes;
  image_module::Picture picture{};
  std::function<bool()> stop;
  mutable std::exception_ptr thrown{};  ///< the exception of `stop`
};

/// The plan of a file of this name, or the error in these arguments. `format` is null for an
/// unknown extension. The plan is on the heap, because its picture points into it.
Result<std::unique_ptr<ImagePlan>> make_plan(const ImageForm& form, const std::string& path,
                                             const ImageFileOptions& options,
                                             const ImageFormat* format);

}  // namespace boule
