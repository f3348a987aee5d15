#pragma once

#include <algorithm>
#include <cstring>
#include <exception>
#include <string>

#include "render/image/module/image_module.h"

/// Helpers that fill in the Report of the functions of a Table: those of the module, and the
/// built-in ones.
namespace boule::image_module {

inline void fail(Report* report, const std::string& text) {
  report->outcome = Outcome::failed;
  const std::size_t length = std::min(text.size(), sizeof report->text - 1);
  std::memcpy(report->text, text.data(), length);
  report->text[length] = 0;
}

/// Reports the errno code of a file, unless it is 0. Returns whether it reported one.
inline bool fail_by(int code, Report* report) {
  if (code == 0) return false;
  report->outcome = Outcome::system_error;
  report->code = code;
  return true;
}

/// Runs a step and turns its exceptions into reports, because they must stay within the module.
template <class Step>
void guarded(Report* report, const Step& step) {
  *report = {};
  try {
    step();
  } catch (const std::exception& error) {
    fail(report, error.what());
  } catch (...) {
    fail(report, "an unknown exception");
  }
}

}  // namespace boule::image_module
