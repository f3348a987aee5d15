#pragma once

#include <chrono>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "render/apps/team/team_letters.h"

namespace boule {

/// What the leader knows of the work of a rank.
struct RankWork {
  std::string host;
  std::uint64_t blocks = 0, rays = 0;
  double seconds = 0;  ///< of its threads' rendering, together
};

/// A rank, as another one knows it.
struct KnownRank {
  RankName name;
  RankWork work;
  std::chrono::steady_clock::time_point heard;  ///< its last sign of life
  double patience = 0;                          ///< seconds without one that it has announced
  bool here = false, ended = false;
  bool compared = false;  ///< its facts, with the leader's
  int ready = -1;         ///< the picture that it is ready for
  std::string facts;
  std::size_t in_hand = 0, last_portion = 0;  ///< blocks
};

/// The ranks of a team as one of them knows them. The leader watches all, the others watch the
/// leader, which is rank 0.
class TeamRanks {
 public:
  /// Of rank 0 alone, until it knows more.
  TeamRanks() : ranks_(1) {}
  TeamRanks(int own, int size, const RankName& name);

  [[nodiscard]] int own() const { return own_; }
  [[nodiscard]] int size() const { return static_cast<int>(ranks_.size()); }
  [[nodiscard]] bool leads() const { return own_ == 0; }
  KnownRank& operator[](int number) { return ranks_[static_cast<std::size_t>(number)]; }
  [[nodiscard]] auto begin() { return ranks_.begin(); }
  [[nodiscard]] auto end() { return ranks_.end(); }
  [[nodiscard]] auto begin() const { return ranks_.begin(); }
  [[nodiscard]] auto end() const { return ranks_.end(); }
  /// The ranks that this one writes letters to without being asked.
  [[nodiscard]] std::vector<int> watched() const;

  /// "rank 3 (process 4711 on node7)".
  [[nodiscard]] std::string called(int number) const;
  /// Ranks that are not here yet count as if they had as many threads as this one.
  [[nodiscard]] int all_threads() const;
  [[nodiscard]] bool all_ended() const;
  /// Whether every other rank's facts were compared. One that ended before that has failed, or
  /// found no picture to begin.
  [[nodiscard]] bool all_compared() const;

  struct Lost {
    int number;
    std::string what;
  };
  /// A watched rank whose process `is_gone`, or that was silent for so many seconds; looks ten
  /// times a second.
  std::optional<Lost> find_lost(double silence,
                                const std::function<bool(const RankName&)>& is_gone);

 private:
  std::vector<KnownRank> ranks_;
  int own_ = 0;
  int gone_checks_ = 0;  ///< in how many the leader was gone
  std::chrono::steady_clock::time_point checked_;
};

}  // namespace boule
