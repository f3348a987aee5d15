#include "bench/rank_simulation.h"

#include <algorithm>
#include <deque>
#include <numeric>
#include <queue>
#include <utility>

#include "render/apps/team/block_dealer.h"

namespace boule::bench {
namespace {

enum class Kind { work_arrives, block_ends, result_arrives };

struct Event {
  double time;
  Kind kind;
  int rank;
  std::vector<std::uint32_t> blocks;  ///< of the letter
};
struct Later {
  bool operator()(const Event& a, const Event& b) const { return a.time > b.time; }
};

struct Rank {
  std::deque<std::uint32_t> queue;
  std::vector<std::uint32_t> done;  ///< rendered and not sent
  double sent = 0;                  ///< when the last result was
  bool busy = false;
  std::size_t in_hand = 0, last_portion = 0;  ///< as the leader knows
};

class Simulation {
 public:
  explicit Simulation(const SimulatedRun& run)
      : run_(run),
        dealer_(numbers(run.costs.size())),
        ranks_(static_cast<std::size_t>(run.ranks)) {}

  SimulatedEnd play() {
    for (int rank = 0; rank < run_.ranks; ++rank) deal(rank, 0);
    while (!events_.empty()) {
      const Event event = events_.top();
      events_.pop();
      handle(event);
    }
    const double all = std::accumulate(run_.costs.begin(), run_.costs.end(), 0.0);
    return {end_, all / (run_.ranks * end_), letters_};
  }

 private:
  static std::vector<std::uint32_t> numbers(std::size_t count) {
    std::vector<std::uint32_t> all(count);
    std::iota(all.begin(), all.end(), 0U);
    return all;
  }
  /// When a letter that is sent now has passed the leader's link and was seen.
  double arrival(double now, double bytes, int rank, double& link_free) {
    if (rank == 0) return now;
    ++letters_;
    link_free = std::max(link_free, now) + bytes / run_.network.bytes_per_second;
    return link_free + run_.network.latency + run_.network.look_interval;
  }
  void deal(int number, double now) {
    Rank& rank = ranks_[static_cast<std::size_t>(number)];
    while (dealer_.left() > 0 && dealer_.wants(rank.in_hand, rank.last_portion, 1, run_.ranks)) {
      auto blocks = dealer_.deal(1, run_.ranks);
      rank.in_hand += blocks.size();
      rank.last_portion = blocks.size();
      const double at = arrival(now, 4.0 * static_cast<double>(blocks.size()), number, out_free_);
      events_.push({at, Kind::work_arrives, number, std::move(blocks)});
    }
  }
  void begin_block(int number, double now) {
    Rank& rank = ranks_[static_cast<std::size_t>(number)];
    if (rank.busy || rank.queue.empty()) return;
    rank.busy = true;
    events_.push({now + run_.costs[rank.queue.front()], Kind::block_ends, number, {}});
  }
  void send(int number, double now) {
    Rank& rank = ranks_[static_cast<std::size_t>(number)];
    constexpr double interval = 0.5;
    if (rank.queue.size() > 1 && now - rank.sent < interval) return;
    rank.sent = now;
    const double bytes = run_.block_bytes * static_cast<double>(rank.done.size());
    const double at = arrival(now, bytes, number, in_free_);
    taken_ = std::max(taken_, at) + bytes / run_.network.taken_per_second;
    events_.push({taken_, Kind::result_arrives, number, std::exchange(rank.done, {})});
  }
  void handle(const Event& event) {
    Rank& rank = ranks_[static_cast<std::size_t>(event.rank)];
    switch (event.kind) {
      case Kind::work_arrives:
        rank.queue.insert(rank.queue.end(), event.blocks.begin(), event.blocks.end());
        begin_block(event.rank, event.time);
        break;
      case Kind::block_ends:
        rank.busy = false;
        rank.done.push_back(rank.queue.front());
        rank.queue.pop_front();
        send(event.rank, event.time);
        begin_block(event.rank, event.time);
        break;
      case Kind::result_arrives:
        rank.in_hand -= event.blocks.size();
        end_ = std::max(end_, event.time);
        deal(event.rank, event.time);
        break;
    }
  }

  const SimulatedRun& run_;
  BlockDealer dealer_;
  std::vector<Rank> ranks_;
  std::priority_queue<Event, std::vector<Event>, Later> events_;
  double in_free_ = 0, out_free_ = 0, taken_ = 0, end_ = 0;
  std::uint64_t letters_ = 0;
};

}  // namespace

SimulatedEnd simulate(const SimulatedRun& run) { return Simulation(run).play(); }

}  // namespace boule::bench
