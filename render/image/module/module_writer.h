#pragma once

#include <OpenImageIO/imageio.h>

#include <cstddef>
#include <memory>
#include <string>
#include <vector>

#include "render/image/module/descriptor_proxy.h"
#include "render/image/module/image_module.h"
#include "render/image/module/module_report.h"

/// The part of the image module that writes. Only the module's sources include this.
namespace boule::image_module {

/// OpenImageIO's message in one line.
std::string reason_of(std::string text);

OIIO::TypeDesc type_of(SampleType type);

/// Buffers rows and passes a fixed number at a time to OpenImageIO, whatever the portions of the
/// caller: the bytes of some formats depend on it.
struct Writer {
 public:
  Writer(const Picture& picture, int descriptor) : picture_(picture), proxy_(descriptor) {}

  void open(const OIIO::ImageSpec& spec, Report* report);
  void put(const Samples* samples, int rows, Report* report);
  void close(Report* report);

 private:
  void gather(const Samples* samples, int first, int rows);
  void write_gathered(Report* report);
  void write_noise();

  const Picture& picture_;
  DescriptorProxy proxy_;
  std::unique_ptr<OIIO::ImageOutput> output_;  ///< after the proxy, which it uses
  std::size_t pixel_size_ = 0;                 ///< bytes
  int at_once_ = 0;                            ///< rows per call of OpenImageIO
  int written_ = 0, gathered_ = 0;             ///< rows
  std::vector<unsigned char> packed_;          ///< the buffered rows
};

}  // namespace boule::image_module
