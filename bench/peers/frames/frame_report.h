#pragma once

#include <string>

#include "bench/peers/frames/frames.h"
#include "bench/peers/machine.h"

namespace boule::bench {

/// Two lines: the machine, and how it was measured.
void print_frame_machine(const Machine& machine, const FrameSettings& settings);

/// One scene's tables, a line a program.
void print_frames(const FrameResults& results);

/// Writes {"machine": {...}, "settings": {...}, "frames": [...], "scaling": [...]}.
Status write_frames_json(const std::string& path, const Machine& machine,
                         const FrameSettings& settings, const FrameResults& results);

}  // namespace boule::bench
