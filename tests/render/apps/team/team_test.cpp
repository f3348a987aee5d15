// Teams whose ranks are threads of this process: who gets which work, and what happens when one is
// not as the others.
#include "render/apps/team/team.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <atomic>
#include <map>
#include <thread>

#include "tests/render/apps/team/memory_post.h"

namespace boule::test {
namespace {

using testing::HasSubstr;

class TeamTest : public testing::Test {
 protected:
  static TeamSettings settings(int rank) {
    TeamSettings one;
    one.name = {"host", 100 + rank, "here", 2};
    one.version = "1";
    return one;
  }
  /// Runs body(team, rank) on each rank, and gives their exit codes.
  std::vector<int> run(int size, const std::function<int(Team&, int)>& body,
                       const std::function<void(TeamSettings&, int)>& change = {}) {
    const auto mail = std::make_shared<MemoryMail>(size);
    std::vector<int> codes(static_cast<std::size_t>(size));
    std::vector<std::thread> threads;
    for (int rank = 0; rank < size; ++rank) {
      threads.emplace_back([&, rank] {
        TeamSettings own = settings(rank);
        if (change) change(own, rank);
        const auto open = [&mail, rank] {
          return Result<std::unique_ptr<Post>>(std::make_unique<MemoryPost>(mail, rank));
        };
        auto team = Team::join(open, own);
        ASSERT_TRUE(team);
        const int code = body(*team.value(), rank);
        codes[static_cast<std::size_t>(rank)] = team.value()->leave(code, code != 0 ? "bad" : "");
        if (rank == 0) failures_ = team.value()->failures();
      });
    }
    for (std::thread& thread : threads) thread.join();
    return codes;
  }
  /// A picture of `count` blocks whose parts are their numbers as text.
  TeamPicture picture(int number, std::uint32_t count, const std::string& scene = "abc") {
    TeamPicture one;
    one.number = number;
    one.facts = {{"version", "1"}, {"scene", scene}};
    for (std::uint32_t i = 0; i < count; ++i) one.blocks.push_back(i);
    one.take = [this, number](std::uint32_t block, std::string_view part) {
      EXPECT_EQ(part, std::to_string(number) + "/" + std::to_string(block));
      ++taken_[{number, block}];
      return true;
    };
    return one;
  }
  static Status render(Team& team, TeamPicture one) {
    const int number = one.number;
    team.begin(std::move(one));
    std::thread other([&] { work(team, number); });
    work(team, number);
    other.join();
    return team.end();
  }
  static void work(Team& team, int number) {
    while (const auto block = team.next_block())
      team.give(*block, std::to_string(number) + "/" + std::to_string(*block), 10, 0.001);
  }

  std::map<std::pair<int, std::uint32_t>, int> taken_;  ///< how often, on the leader
  std::string failures_;
};

TEST_F(TeamTest, EachBlockIsRenderedOnce) {
  for (const int size : {1, 2, 7}) {
    taken_.clear();
    const auto codes = run(size, [&](Team& team, int) {
      for (int number = 0; number < 3; ++number) EXPECT_TRUE(render(team, picture(number, 200)));
      return 0;
    });
    EXPECT_EQ(codes, std::vector<int>(static_cast<std::size_t>(size), 0));
    EXPECT_EQ(taken_.size(), 600U);
    for (const auto& [block, times] : taken_) EXPECT_EQ(times, 1) << block.first;
  }
}

TEST_F(TeamTest, TheLeaderMaySkipAPicture) {
  const auto codes = run(3, [&](Team& team, int rank) {
    if (rank == 0) {
      team.skip(0);
    } else {
      EXPECT_TRUE(render(team, picture(0, 5)));
    }
    EXPECT_TRUE(render(team, picture(1, 50)));
    return 0;
  });
  EXPECT_EQ(codes, std::vector<int>(3, 0));
  EXPECT_EQ(taken_.size(), 50U);
}

TEST_F(TeamTest, FramesAreDealtOnceEach) {
  std::mutex mutex;
  std::map<int, int> frames;
  run(4, [&](Team& team, int) {
    while (const auto frame = team.next_frame(100)) {
      const std::lock_guard lock(mutex);
      ++frames[*frame];
    }
    return 0;
  });
  EXPECT_EQ(frames.size(), 100U);
  for (const auto& [frame, times] : frames) EXPECT_EQ(times, 1) << frame;
}

TEST_F(TeamTest, ARankWithAnotherSceneIsNamed) {
  const auto codes = run(3, [&](Team& team, int rank) {
    const Status done = render(team, picture(0, 1'000'000, rank == 2 ? "xyz" : "abc"));
    return done || rank != 0 ? 0 : 1;
  });
  EXPECT_EQ(codes, std::vector<int>(3, 1));
  EXPECT_EQ(failures_, "rank 2 (process 102 on host) is of another scene: hash xyz, not abc");
}

TEST_F(TeamTest, ARankOfAnotherVersionIsNamed) {
  const auto codes = run(
      3,
      [&](Team& team, int rank) {
        const Status done = render(team, picture(0, 1'000'000));
        return done || rank != 0 ? 0 : 1;
      },
      [](TeamSettings& own, int rank) { own.version = rank == 1 ? "0.9" : "1"; });
  EXPECT_EQ(codes, std::vector<int>(3, 1));
  EXPECT_EQ(failures_, "rank 1 (process 101 on host) is boule 0.9, rank 0 is boule 1");
}

TEST_F(TeamTest, ARankThatFailsEndsAll) {
  const auto codes = run(3, [&](Team& team, int rank) {
    if (rank == 1) return 3;
    const Status done = render(team, picture(0, 1'000'000));
    return done || rank != 0 ? 0 : 1;
  });
  EXPECT_EQ(codes[0], 1);
  EXPECT_EQ(failures_, "rank 1 (process 101 on host) failed: bad");
}

/// The others have begun a picture that the leader never begins.
TEST_F(TeamTest, ALeaderThatFailsEndsAll) {
  const auto codes = run(3, [&](Team& team, int rank) {
    if (rank == 0) return 3;
    static_cast<void>(render(team, picture(0, 100)));
    return 0;
  });
  EXPECT_EQ(codes, std::vector<int>(3, 3));
}

TEST_F(TeamTest, SignalsOnAnyRankReachTheLeader) {
  const auto codes = run(3, [&](Team& team, int rank) {
    TeamPicture one = picture(0, 1'000'000);
    if (rank == 0) {
      one.tick = [&team] {
        if (team.caught()) team.stop();
      };
    }
    if (rank == 2) one.tick = [&team] { team.stop(); };
    const Status ended = render(team, std::move(one));
    EXPECT_FALSE(ended);
    return rank == 0 ? 143 : 0;
  });
  EXPECT_EQ(codes, std::vector<int>(3, 143));
}

/// The rank never says anything, and the others are told by the clock.
TEST_F(TeamTest, SilentRanksAreNamedAndEndAll) {
  const auto mail = std::make_shared<MemoryMail>(2);
  std::atomic<bool> lost{false};
  std::string why;
  TeamSettings own = settings(0);
  own.silence = 0.3;
  own.lost = [&](const std::string& text) {
    if (!lost.exchange(true)) why = text;
  };
  auto team = Team::join(
      [&] { return Result<std::unique_ptr<Post>>(std::make_unique<MemoryPost>(mail, 0)); }, own);
  while (!lost) std::this_thread::yield();
  team.value().reset();
  EXPECT_THAT(why, HasSubstr("rank 1 has given no sign of life for "));
  EXPECT_TRUE(mail->ended);
}

TEST_F(TeamTest, DeadRanksAreNamed) {
  const auto mail = std::make_shared<MemoryMail>(2);
  std::atomic<bool> lost{false};
  std::string why;
  TeamSettings own = settings(0);
  own.is_gone = [](const RankName& name) { return name.process == 101; };
  own.lost = [&](const std::string& text) {
    if (!lost.exchange(true)) why = text;
  };
  MemoryPost other(mail, 1);
  ByteWriter hello = letter_of(LetterKind::hello);
  hello.put(std::string("1"), settings(1).name);
  other.send(0, hello.take());
  auto team = Team::join(
      [&] { return Result<std::unique_ptr<Post>>(std::make_unique<MemoryPost>(mail, 0)); }, own);
  while (!lost) std::this_thread::yield();
  team.value().reset();
  EXPECT_EQ(why, "rank 1 (process 101 on host) is gone");
}

TEST_F(TeamTest, NoPostIsAnError) {
  const auto team = Team::join(
      [] { return Result<std::unique_ptr<Post>>(Diagnostic::of("no module")); }, settings(0));
  ASSERT_FALSE(team);
  EXPECT_EQ(team.error().message, "no module");
}

TEST(Letters, RefusesLettersThatAreTooShort) {
  ByteWriter writer = letter_of(LetterKind::result);
  writer.put(7, std::string("part"), std::vector<std::uint32_t>{1, 2, 3});
  const std::string whole = writer.take();
  for (std::size_t length = 0; length <= whole.size(); ++length) {
    ByteReader reader(std::string_view(whole).substr(0, length));
    kind_of(reader);
    reader.get<int>();
    reader.get<std::string>();
    reader.get<std::vector<std::uint32_t>>();
    EXPECT_EQ(reader.good(), length == whole.size());
  }
}

}  // namespace
}  // namespace boule::test
