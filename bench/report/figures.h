#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "bench/errors/capsule_errors.h"
#include "bench/errors/epsilons.h"
#include "bench/errors/hard_errors.h"
#include "bench/errors/noise_errors.h"
#include "bench/errors/path_errors.h"
#include "bench/report/error_map.h"
#include "bench/report/growth.h"
#include "bench/report/peer_rows.h"
#include "bench/textbook/solver_speeds.h"

namespace boule::bench {

/// How much is measured.
struct ReportSettings {
  bool quick = false;
  std::uint64_t seed = 20261121;  ///< of the epsilon experiment; the others' are in their sources
};

/// The machine and the build that the figures were measured with.
struct Provenance {
  std::string cpu;
  unsigned cores = 0;
  std::string compiler, flags, commit;
  std::string date;  ///< from SOURCE_DATE_EPOCH; empty without it
  std::string command;
};

/// One contender's errors in one hard case, of spheres or of capsules.
struct CaseErrors {
  std::string hard_case, isa;
  HardErrors errors;
};

/// A scene of the gallery, path-traced.
struct ScenePathErrors {
  std::string scene;
  PathErrors errors;
};

/// A scene of the gallery with as many samples everywhere, and with as many as pixels need.
struct SceneNoiseErrors {
  std::string scene;
  NoiseErrors errors;
};

/// All figures and pictures of the report.
struct Figures {
  ReportSettings settings;
  Provenance provenance;
  std::vector<SolverSpeed> speeds;
  std::vector<CaseErrors> cases;     ///< of every ISA
  std::vector<CaseErrors> capsules;  ///< of the widest
  std::string widest;                ///< the ISA of the map
  ErrorMap map;
  std::vector<EpsilonFigure> epsilons;
  std::vector<EpsilonPicture> pictures;
  std::vector<Growth> growth;
  std::vector<ScenePathErrors> paths;
  std::vector<SceneNoiseErrors> noise;
  std::optional<PeerRows> peers;  ///< none without Embree
};

/// Runs all measurements; names each on standard error as it starts.
Figures measure(const ReportSettings& settings, const std::string& command);

/// The figures as JSON; the pictures as PNG in hexadecimal digits.
std::string to_json(const Figures& figures);

}  // namespace boule::bench
