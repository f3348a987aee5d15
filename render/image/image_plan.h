#pragma once

#include <exception>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "core/base/error.h"
#include "render/image/band_writer.h"
#include "render/image/image_format.h"
#include "render/image/image_module.h"

namespace boule {

/// What the module reads of a picture to be written: plain structs, and what they point to.
struct ImagePlan {
  ImageForm form;
  std::vector<image_module::Channel> channels;
  Metadata metadata;
  std::vector<image_module::Attribute> attributes;
  image_module::Picture picture{};
  std::function<bool()> stop;
  mutable std::exception_ptr thrown{};  ///< what `stop` threw
};

/// The plan of a file of this name, or what is wrong with these arguments. `format` is null if the
/// name has no known extension. The plan is on the heap, because its picture points into it.
Result<std::unique_ptr<ImagePlan>> make_plan(const ImageForm& form, const std::string& path,
                                             const ImageFileOptions& options,
                                             const ImageFormat* format);

}  // namespace boule
