#pragma once

#include <span>
#include <string_view>

namespace boule::view {

/// A file of the page, which is embedded in the program.
struct PageFile {
  std::string_view name;  ///< "view.js"
  std::string_view type;  ///< "text/javascript; charset=utf-8"
  std::string_view bytes;
};

/// All of them; "index.html" is the page itself.
std::span<const PageFile> page_files();

}  // namespace boule::view
