#pragma once

namespace boule::cli {

/// Opens those of the descriptors 0, 1 and 2 that are closed: otherwise the next file to be opened
/// would be standard output or error, and get what is meant for them. Call it before anything else.
void open_closed_streams();

}  // namespace boule::cli
