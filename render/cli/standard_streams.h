#pragma once

namespace boule::cli {

/// Opens those of the descriptors 0, 1 and 2 that are closed. Otherwise the next file that is
/// opened would become standard output or error, and get the text meant for them. To be called
/// before any file is opened.
void open_closed_streams();

}  // namespace boule::cli
