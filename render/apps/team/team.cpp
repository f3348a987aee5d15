// What every rank of a team does; what the leader does is in team_leader.cpp.
#include "render/apps/team/team.h"

#include <algorithm>
#include <limits>

namespace boule {
namespace {

constexpr std::chrono::milliseconds beat_interval{500};
/// How long letters may wait to be seen: short where a thread may run out of blocks.
constexpr std::chrono::milliseconds short_wait{2}, long_wait{10};
constexpr std::size_t large_letter = 256 << 10;

}  // namespace

Result<std::unique_ptr<Team>> Team::join(const OpenPost& open, TeamSettings settings) {
  std::unique_ptr<Team> team(new Team(std::move(settings)));
  Team* const one = team.get();
  one->thread_.emplace(1, [one, open](std::size_t) { one->run(open); });
  if (one->thread_->size() == 0) return Diagnostic::of("no thread for letters between ranks");
  std::unique_lock lock(one->mutex_);
  one->changed_.wait(lock, [one] { return one->joined_ || one->refused_; });
  if (!one->refused_) return team;
  const Diagnostic refused = *one->refused_;
  lock.unlock();
  return refused;
}

Team::~Team() {
  {
    const std::lock_guard lock(mutex_);
    leaving_ = may_leave_ = true;
  }
  to_send_.notify_all();
  thread_.reset();
}

void Team::run(const OpenPost& open) {
  auto post = open();
  {
    const std::lock_guard lock(mutex_);
    if (post) {
      post_ = std::move(post).value();
      ranks_ = TeamRanks(post_->rank(), post_->size(), settings_.name);
      joined_ = true;
    } else {
      refused_ = post.error();
    }
  }
  changed_.notify_all();
  if (post_) work_until_left();
}

void Team::send_hello() {
  for (const int to : ranks_.watched()) {
    ByteWriter hello = letter_of(LetterKind::hello);
    hello.put(settings_.version, settings_.name);
    send(to, hello.take());
  }
}

void Team::work_until_left() {
  send_hello();
  for (;;) {
    bool any = false;
    while (const auto letter = post_->receive()) {
      any = true;
      read(*letter);
    }
    if (leads()) take_own();
    check_ranks();
    call_picture([this] {
      if (picture_.tick) picture_.tick();
    });
    std::unique_lock lock(mutex_);
    leads() ? deal() : send_results();
    beat();
    while (!outbox_.empty()) {
      send(outbox_.front().first, outbox_.front().second);
      outbox_.pop_front();
    }
    if (leaving_ && may_leave_) break;
    const bool is_low = queue_.size() <= static_cast<std::size_t>(settings_.name.threads);
    if (!any) to_send_.wait_for(lock, is_low ? short_wait : long_wait);
  }
  while (!post_->idle()) static_cast<void>(post_->receive());
  post_->finish();
  const std::lock_guard lock(mutex_);
  left_ = true;
  changed_.notify_all();
}

/// Calls one of the picture's functions, without the mutex, unless the picture has ended.
template <class Call>
void Team::call_picture(const Call& call) {
  {
    const std::lock_guard lock(mutex_);
    if (stage_ != Stage::renders) return;
    ++calls_;
  }
  call();
  const std::lock_guard lock(mutex_);
  --calls_;
  changed_.notify_all();
}

void Team::call_lost() {
  call_picture([this] {
    if (picture_.lost) picture_.lost();
  });
}

/// On the team's thread only.
void Team::send(int to, const std::string& letter) {
  ++traffic_.letters;
  traffic_.bytes += letter.size();
  post_->send(to, letter);
}

void Team::read(const Letter& letter) {
  ByteReader reader(letter.bytes);
  const auto kind = kind_of(reader);
  KnownRank& rank = ranks_[letter.from];
  {
    const std::lock_guard lock(mutex_);
    ++traffic_.letters;
    traffic_.bytes += letter.bytes.size();
    rank.heard = Clock::now();
    rank.patience = kind == LetterKind::beat ? reader.get<double>() : rank.patience;
  }
  if (leads()) {
    read_from_rank(kind, rank, letter.from, reader);
  } else {
    read_from_leader(kind, reader);
  }
  changed_.notify_all();
}

void Team::read_from_leader(LetterKind kind, ByteReader& letter) {
  const std::lock_guard lock(mutex_);
  switch (kind) {
    case LetterKind::hello: {
      static_cast<void>(letter.get<std::string>());  // the version: the leader compares it
      letter.read(ranks_[0].name);
      break;
    }
    case LetterKind::work: {
      const int picture = letter.get<int>();
      const auto blocks = letter.get<std::vector<std::uint32_t>>();
      if (picture == number_) queue_.insert(queue_.end(), blocks.begin(), blocks.end());
      break;
    }
    case LetterKind::stop:
      stop_number_ = letter.get<int>();
      if (letter.get<bool>()) stopped_ = true;
      break;
    case LetterKind::frame:
      frame_answer_ = letter.get<int>();
      break;
    case LetterKind::leave:
      code_ = letter.get<int>();
      may_leave_ = true;
      break;
    default:
      break;
  }
}

void Team::begin(TeamPicture picture) {
  const std::lock_guard lock(mutex_);
  picture_ = std::move(picture);
  number_ = picture_.number;
  stage_ = Stage::renders;
  if (leads()) {
    missing_ = picture_.blocks.size();
    dealer_.emplace(std::move(picture_.blocks));
    for (KnownRank& rank : ranks_) rank.in_hand = rank.last_portion = 0;
    ranks_[0].ready = number_;
  } else {
    ByteWriter letter = letter_of(LetterKind::facts);
    letter.add(number_);
    for (const auto& [name, value] : picture_.facts) letter.put(name, value);
    outbox_.emplace_back(0, letter.take());
  }
  to_send_.notify_all();
}

void Team::skip(int number) {
  const std::lock_guard lock(mutex_);
  number_ = number;
  finish_picture();
  to_send_.notify_all();
}

std::optional<std::uint32_t> Team::next_block() {
  std::unique_lock lock(mutex_);
  const auto is_over = [this] {
    return stopped_ || failure_code_ != 0 || stop_number_ >= number_ || (leads() && missing_ == 0);
  };
  changed_.wait(lock, [&] { return !queue_.empty() || is_over(); });
  if (stopped_ || failure_code_ != 0 || queue_.empty()) return std::nullopt;
  const std::uint32_t block = queue_.front();
  queue_.pop_front();
  return block;
}

void Team::give(std::uint32_t block, std::string part, std::uint64_t rays, double seconds) {
  const std::lock_guard lock(mutex_);
  given_.push_back({block, std::move(part), rays, seconds});
  to_send_.notify_all();
}

/// Under the mutex. What is rendered waits for more of it, but not while the leader should know
/// that this rank has not much left.
void Team::send_results() {
  if (given_.empty()) return;
  std::size_t bytes = 0;
  for (const Given& one : given_) bytes += one.part.size();
  const auto now = Clock::now();
  const bool is_low = queue_.size() <= static_cast<std::size_t>(settings_.name.threads);
  if (!is_low && bytes < large_letter && now - sent_ < beat_interval) return;
  ByteWriter letter = letter_of(LetterKind::result);
  letter.add(number_);
  for (const Given& one : given_) letter.put(one.block, one.rays, one.seconds, one.part);
  given_.clear();
  sent_ = now;
  outbox_.emplace_back(0, letter.take());
}

/// Under the mutex.
void Team::beat() {
  const auto now = Clock::now();
  if (now - beaten_ < beat_interval) return;
  beaten_ = now;
  for (const int to : ranks_.watched()) {
    ByteWriter letter = letter_of(LetterKind::beat);
    letter.add(std::exchange(patience_, 0));
    outbox_.emplace_back(to, letter.take());
  }
}

void Team::be_patient(double seconds) {
  const std::lock_guard lock(mutex_);
  patience_ = seconds;
  beaten_ = {};
  to_send_.notify_all();
}

Status Team::end() {
  std::unique_lock lock(mutex_);
  if (leads()) {
    changed_.wait(lock, [this] {
      return (missing_ == 0 && ranks_.all_compared()) || stopped_ || failure_code_ != 0;
    });
    finish_picture();
  } else {
    changed_.wait(lock, [this] { return stop_number_ >= number_ || may_leave_; });
  }
  stage_ = Stage::ended;
  changed_.wait(lock, [this] { return calls_ == 0; });
  queue_.clear();
  to_send_.notify_all();
  if (failure_code_ != 0) return Diagnostic::of(failures_);
  if (stopped_) return Diagnostic::of("rendering was cancelled");
  return {};
}

void Team::stop() {
  const std::lock_guard lock(mutex_);
  if (leads()) {
    stopped_ = true;
  } else if (!std::exchange(caught_told_, true)) {
    outbox_.emplace_back(0, letter_of(LetterKind::caught).take());
  }
  changed_.notify_all();
  to_send_.notify_all();
}

bool Team::stopped() const {
  const std::lock_guard lock(mutex_);
  return stopped_ || failure_code_ != 0;
}

bool Team::caught() const {
  const std::lock_guard lock(mutex_);
  return caught_;
}

std::optional<int> Team::next_frame(int count) {
  std::unique_lock lock(mutex_);
  if (leads()) {
    frame_count_ = count;
    to_send_.notify_all();
    if (stopped_ || failure_code_ != 0 || frames_dealt_ >= count) return std::nullopt;
    return frames_dealt_++;
  }
  frame_answer_.reset();
  outbox_.emplace_back(0, letter_of(LetterKind::frame).take());
  to_send_.notify_all();
  changed_.wait(lock, [this] { return frame_answer_ || may_leave_; });
  if (!frame_answer_ || *frame_answer_ < 0) return std::nullopt;
  return *frame_answer_;
}

int Team::leave(int code, const std::string& text) {
  std::unique_lock lock(mutex_);
  leaving_ = true;
  if (leads()) {
    frame_count_ = std::max(frame_count_, 0);
    if (code != 0) frames_dealt_ = frame_count_;
    code_ = code;
    ranks_[0].ended = true;
    stopped_ = stopped_ || code != 0;
    number_ = std::numeric_limits<int>::max();  // no rank waits for a picture that never begins
    finish_picture();
  } else {
    ByteWriter letter = letter_of(LetterKind::ended);
    letter.put(code, text);
    outbox_.emplace_back(0, letter.take());
  }
  to_send_.notify_all();
  changed_.wait(lock, [this] { return left_; });
  return code_ != 0 ? code_ : failure_code_;
}

std::string Team::failures() const {
  const std::lock_guard lock(mutex_);
  return failures_;
}

TeamTraffic Team::traffic() const {
  const std::lock_guard lock(mutex_);
  return traffic_;
}

}  // namespace boule
