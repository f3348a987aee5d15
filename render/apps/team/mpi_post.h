#pragma once

#include <memory>
#include <string>

#include "core/base/error.h"
#include "render/apps/team/post.h"

namespace boule {

/// Loads a module for MPI from where the image module is looked for, and joins the other processes
/// that its launcher started. To be called by the thread that will use the post. The Diagnostic
/// says where the module was looked for, or what the system said.
Result<std::unique_ptr<Post>> open_mpi_post(const std::string& module);

}  // namespace boule
