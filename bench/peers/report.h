#pragma once

#include <string>
#include <vector>

#include "bench/peers/machine.h"
#include "bench/peers/referee.h"
#include "core/base/error.h"

namespace boule::bench {

/// Two lines: the machine, and how it was measured.
void print_machine(const Machine& machine, const RefereeSettings& settings);

/// One workload's table, a line a contender.
void print_workload(const Check& check, const std::vector<Row>& rows);

/// Writes {"machine": {...}, "settings": {...}, "checks": [...], "rows": [...]}.
Status write_json(const std::string& path, const Machine& machine, const RefereeSettings& settings,
                  const Results& results);

}  // namespace boule::bench
