#pragma once

#include <chrono>
#include <condition_variable>
#include <cstdint>
#include <deque>
#include <functional>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "core/base/error.h"
#include "render/apps/parts/run_facts.h"
#include "render/apps/team/block_dealer.h"
#include "render/apps/team/post.h"
#include "render/apps/team/team_letters.h"
#include "render/apps/team/team_ranks.h"
#include "render/threads/threads.h"

namespace boule {

/// How a team works.
struct TeamSettings {
  RankName name;        ///< of this rank
  std::string version;  ///< of the program; all ranks have the same
  double silence = 8;   ///< seconds without a sign of life after which a rank counts as lost
  /// Whether the process of a rank certainly runs no more; asked ten times a second.
  std::function<bool(const RankName&)> is_gone;
  /// Tells why all ranks are ended at once. Called on the team's thread.
  std::function<void(const std::string& why)> lost;
};

/// A picture that a team renders by blocks. The functions are called on the team's thread.
struct TeamPicture {
  int number = 0;                     ///< among those of a series, ascending
  RunFacts facts;                     ///< the same on all ranks, or it is refused
  std::vector<std::uint32_t> blocks;  ///< the leader's: to be rendered, in this order
  /// The leader's: takes a block's part. False: it cannot be one.
  std::function<bool(std::uint32_t block, std::string_view part)> take;
  std::function<void()> tick;  ///< called often
  std::function<void()> lost;  ///< the leader's: called before TeamSettings::lost
};

/// Letters and bytes that a rank has sent and received.
struct TeamTraffic {
  std::uint64_t letters = 0, bytes = 0;
};

/// Processes that render together. Rank 0 leads: it hands out blocks or frames and gathers what is
/// rendered; all ranks render, the leader too. A thread of the team carries the letters, so that
/// each rank gives signs of life whatever its other threads do.
class Team {
 public:
  using OpenPost = std::function<Result<std::unique_ptr<Post>>()>;
  /// Joins the others; `open` is called on the team's thread.
  static Result<std::unique_ptr<Team>> join(const OpenPost& open, TeamSettings settings);
  Team(const Team&) = delete;
  Team& operator=(const Team&) = delete;
  ~Team();

  [[nodiscard]] int rank() const { return ranks_.own(); }
  [[nodiscard]] int size() const { return ranks_.size(); }
  [[nodiscard]] bool leads() const { return ranks_.leads(); }

  /// Begins a picture, one after the other; all ranks the same, but for those that the leader
  /// skips.
  void begin(TeamPicture picture);
  /// The leader's: there will be no such picture.
  void skip(int number);
  /// The next block to render, for any thread; waits for it. None: the picture ends.
  std::optional<std::uint32_t> next_block();
  /// Gives the part of a block that next_block() gave.
  void give(std::uint32_t block, std::string part, std::uint64_t rays, double seconds);
  /// Waits until the leader has all blocks and knows of every rank whether it differs, or stop()
  /// was called. An error if a rank failed or differs; on other ranks never. No function of the
  /// picture is called afterwards.
  Status end();
  /// Ends the picture early, on any thread. On other ranks than the leader it tells the leader that
  /// a signal came.
  void stop();
  /// Whether the picture is ended early, or a signal came on another rank.
  [[nodiscard]] bool stopped() const;
  [[nodiscard]] bool caught() const;
  /// Announces that the next sign of life may take so many seconds, for work that may block.
  void be_patient(double seconds);

  /// The index of the next frame of a series of `count`, the same on all ranks; none: no more.
  std::optional<int> next_frame(int count);

  /// Ends the team's work with an exit code, and what a rank that is not the leader has to tell.
  /// Waits for all. Returns the code of the leader, or that of a rank that failed.
  int leave(int code, const std::string& text);
  /// What the ranks that failed told, with their names.
  [[nodiscard]] std::string failures() const;

  /// The leader's.
  [[nodiscard]] std::vector<RankWork> work() const;
  [[nodiscard]] TeamTraffic traffic() const;

 private:
  using Clock = std::chrono::steady_clock;
  struct Given {
    std::uint32_t block;
    std::string part;
    std::uint64_t rays;
    double seconds;
  };
  enum class Stage { none, renders, ended };

  explicit Team(TeamSettings settings) : settings_(std::move(settings)) {}
  void run(const OpenPost& open);
  template <class Call>
  void call_picture(const Call& call);
  void send_hello();
  void work_until_left();
  void send(int to, const std::string& letter);
  void read(const Letter& letter);
  void read_from_rank(LetterKind kind, KnownRank& rank, int number, ByteReader& letter);
  void read_from_leader(LetterKind kind, ByteReader& letter);
  void read_result(KnownRank& rank, ByteReader& letter);
  void take(KnownRank& rank, const Given& one);
  void call_lost();
  void check_facts(KnownRank& rank, int number);
  void deal();
  void deal_to(KnownRank& rank, int number);
  void send_results();
  void take_own();
  void beat();
  void check_ranks();
  void fail(const std::string& why);
  void finish_picture();
  void answer_frame(int number);

  const TeamSettings settings_;
  std::unique_ptr<Post> post_;  ///< the team's thread's
  TeamRanks ranks_;

  mutable std::mutex mutex_;  ///< of all below
  std::condition_variable changed_, to_send_;
  bool joined_ = false;
  std::optional<Diagnostic> refused_;
  std::deque<std::pair<int, std::string>> outbox_;
  TeamPicture picture_;
  Stage stage_ = Stage::none;
  int number_ = -1;  ///< of the picture
  int calls_ = 0;    ///< of its functions, at the moment
  std::optional<BlockDealer> dealer_;
  std::size_t missing_ = 0;  ///< blocks that have not come back
  std::deque<std::uint32_t> queue_;
  std::vector<Given> given_;
  Clock::time_point sent_, beaten_;
  bool stopped_ = false, caught_ = false, caught_told_ = false;
  int stop_number_ = -1;  ///< the last picture that the leader has stopped
  double patience_ = 0;
  std::string failures_;
  int failure_code_ = 0;
  int frames_dealt_ = 0, frame_count_ = -1;
  std::vector<int> frame_askers_;
  std::optional<int> frame_answer_;
  bool leaving_ = false, may_leave_ = false, left_ = false;
  int code_ = 0;
  TeamTraffic traffic_;
  std::optional<Threads> thread_;  ///< last: it uses the others
};

}  // namespace boule
