// What the leader of a team does, and how ranks watch each other.
#include <algorithm>

#include "render/apps/team/team.h"

namespace boule {

void Team::read_from_rank(LetterKind kind, KnownRank& rank, int number, ByteReader& letter) {
  if (kind == LetterKind::result) return read_result(rank, letter);
  const std::lock_guard lock(mutex_);
  switch (kind) {
    case LetterKind::hello: {
      const auto version = letter.get<std::string>();
      letter.read(rank.name);
      rank.work.host = rank.name.host;
      rank.here = true;
      if (version != settings_.version) {
        fail(ranks_.called(number) + " is boule " + printable(version, 40) + ", rank 0 is boule " +
             settings_.version);
      }
      break;
    }
    case LetterKind::facts:
      rank.ready = letter.get<int>();
      rank.facts.clear();
      while (letter.good() && !letter.at_end())
        rank.facts.append(letter.get<std::string>()).push_back('\n');
      break;
    case LetterKind::frame:
      frame_askers_.push_back(number);
      break;
    case LetterKind::caught:
      caught_ = true;
      break;
    case LetterKind::ended: {
      rank.ended = true;
      const int code = letter.get<int>();
      const auto text = letter.get<std::string>();
      if (code != 0 && failure_code_ == 0) {
        fail(ranks_.called(number) + " failed" + (text.empty() ? "" : ": " + text));
        failure_code_ = code;
      }
      break;
    }
    default:
      break;
  }
}

void Team::read_result(KnownRank& rank, ByteReader& letter) {
  const int picture = letter.get<int>();
  while (letter.good() && !letter.at_end()) {
    Given one{};
    one.block = letter.get<std::uint32_t>();
    one.rays = letter.get<std::uint64_t>();
    one.seconds = letter.get<double>();
    one.part = letter.get<std::string>();
    if (picture == number_ && letter.good()) take(rank, one);
  }
}

/// Not under the mutex: it takes its time. Nothing is taken once the picture has ended.
void Team::take(KnownRank& rank, const Given& one) {
  {
    const std::lock_guard lock(mutex_);
    if (stage_ != Stage::renders || missing_ == 0) return;
    ++calls_;
    ++rank.work.blocks;
    rank.work.rays += one.rays;
    rank.work.seconds += one.seconds;
    if (rank.in_hand > 0) --rank.in_hand;
  }
  const bool good = picture_.take(one.block, one.part);
  const std::lock_guard lock(mutex_);
  --calls_;
  good ? static_cast<void>(--missing_) : fail("a rank sent a block that cannot be");
  changed_.notify_all();
}

/// The blocks that the leader has rendered itself.
void Team::take_own() {
  std::vector<Given> own;
  {
    const std::lock_guard lock(mutex_);
    own.swap(given_);
  }
  for (const Given& one : own) take(ranks_[0], one);
}

/// Under the mutex, as all functions below that do not say otherwise.
void Team::deal() {
  for (const int number : std::exchange(frame_askers_, {})) answer_frame(number);
  if (leaving_ && ranks_.all_ended() && !may_leave_) {
    for (int to = 1; to < size(); ++to) {
      ByteWriter letter = letter_of(LetterKind::leave);
      letter.add(code_ != 0 ? code_ : failure_code_);
      outbox_.emplace_back(to, letter.take());
    }
    may_leave_ = true;
  }
  if (stage_ != Stage::renders || stopped_ || failure_code_ != 0) return;
  for (int number = 0; number < size(); ++number) {
    KnownRank& rank = ranks_[number];
    if (rank.ready != number_) continue;
    if (!rank.facts.empty()) check_facts(rank, number);
    if (!std::exchange(rank.compared, true)) changed_.notify_all();
    if (failure_code_ == 0) deal_to(rank, number);
  }
}

void Team::deal_to(KnownRank& rank, int number) {
  const int threads = std::max(rank.name.threads, 1);
  const int all = std::max(ranks_.all_threads(), threads);
  while (dealer_->left() > 0 && dealer_->wants(rank.in_hand, rank.last_portion, threads, all)) {
    const auto blocks = dealer_->deal(threads, all);
    rank.in_hand += blocks.size();
    rank.last_portion = blocks.size();
    if (number == 0) {
      queue_.insert(queue_.end(), blocks.begin(), blocks.end());
      changed_.notify_all();
    } else {
      ByteWriter letter = letter_of(LetterKind::work);
      letter.put(number_, blocks);
      outbox_.emplace_back(number, letter.take());
    }
  }
}

void Team::check_facts(KnownRank& rank, int number) {
  RunFacts facts;
  for (std::size_t at = 0; at < rank.facts.size();) {
    const auto line = [&] {
      const std::size_t end = std::min(rank.facts.find('\n', at), rank.facts.size());
      std::string text = rank.facts.substr(at, end - at);
      at = end + 1;
      return text;
    };
    const std::string name = line();
    facts.emplace_back(name, line());
  }
  rank.facts.clear();
  const std::string difference = find_difference(facts, picture_.facts);
  if (!difference.empty()) fail(ranks_.called(number) + " " + difference);
}

void Team::answer_frame(int number) {
  if (frame_count_ < 0) return frame_askers_.push_back(number);  // the leader is not there yet
  const bool is_left = frames_dealt_ < frame_count_ && !stopped_ && failure_code_ == 0;
  ByteWriter letter = letter_of(LetterKind::frame);
  letter.add(is_left ? frames_dealt_++ : -1);
  outbox_.emplace_back(number, letter.take());
}

void Team::finish_picture() {
  for (int to = 1; to < size(); ++to) {
    ByteWriter letter = letter_of(LetterKind::stop);
    letter.put(number_, stopped_ || failure_code_ != 0);
    outbox_.emplace_back(to, letter.take());
  }
  stop_number_ = number_;
}

void Team::fail(const std::string& why) {
  if (failure_code_ == 0) failures_ = why;
  failure_code_ = std::max(failure_code_, 1);
  changed_.notify_all();
}

/// Not under the mutex. Nothing can be told to a rank that is lost, so all are ended.
void Team::check_ranks() {
  const auto lost = ranks_.find_lost(settings_.silence, settings_.is_gone);
  if (!lost) return;
  call_lost();
  if (settings_.lost) settings_.lost(ranks_.called(lost->number) + " " + lost->what);
  post_->end_all(1);
}

std::vector<RankWork> Team::work() const {
  const std::lock_guard lock(mutex_);
  std::vector<RankWork> all;
  for (const KnownRank& rank : ranks_) all.push_back(rank.work);
  all.front().host = settings_.name.host;
  return all;
}

}  // namespace boule
