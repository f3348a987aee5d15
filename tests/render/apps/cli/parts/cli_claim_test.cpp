// --claim: processes that share a series.
#include <unistd.h>

#include <csignal>
#include <cstdlib>
#include <memory>
#include <random>
#include <thread>

#include "render/apps/cli/process/file_owner.h"
#include "render/apps/cli/render/claim.h"
#include "tests/render/apps/cli/parts/part_program.h"
#include "tests/render/apps/cli/running_program.h"

namespace boule::test {
namespace {

using cli::Claims;
using cli::FileOwner;
using testing::HasSubstr;

class ClaimTest : public PartTest {
 protected:
  std::string picture() const { return path("a.png"); }
  std::string claim_text() const { return read("a.png.claim"); }
};

TEST_F(ClaimTest, OneHasItUntilItEnds) {
  Claims mine, others;
  auto claim = mine.take(picture());
  ASSERT_TRUE(claim && claim.value());
  EXPECT_EQ(FileOwner::parse(claim_text()).process, getpid());
  EXPECT_FALSE(others.take(picture()).value());
  claim.value().reset();
  EXPECT_FALSE(std::filesystem::exists(picture() + ".claim"));
  EXPECT_TRUE(others.take(picture()).value());
}

TEST_F(ClaimTest, AGoneOwnersIsTakenOver) {
  FileOwner gone = FileOwner::self();
  gone.process = 4'194'304;  // above the largest that Linux gives
  write("a.png.claim", gone.text());
  const auto claim = Claims().take(picture());
  ASSERT_TRUE(claim && claim.value());
  EXPECT_EQ(FileOwner::parse(claim_text()).process, getpid());
}

/// The number is in use again, by a process that started at another time.
TEST_F(ClaimTest, ReusedProcessNumberIsNotTheOwner) {
  FileOwner gone = FileOwner::self();
  gone.started = "1";
  write("a.png.claim", gone.text());
  EXPECT_TRUE(Claims().take(picture()).value());
}

TEST_F(ClaimTest, FreshClaimOfAnotherMachineIsKept) {
  FileOwner other = FileOwner::self();
  other.processes = "another boot";
  for (const std::string& text : {other.text(), std::string("no owner"), std::string()}) {
    write("a.png.claim", text);
    EXPECT_FALSE(Claims().take(picture()).value());
    EXPECT_EQ(claim_text(), text);
  }
}

TEST_F(ClaimTest, FirstOwnerKeepsATakenOverClaim) {
  auto claim = Claims().take(picture());
  FileOwner other = FileOwner::self();
  other.processes = "another boot";
  write("a.png.claim", other.text());
  claim.value().reset();
  EXPECT_EQ(claim_text(), other.text());
}

/// Lines "NUMBER" that each frame's statistics are: who wrote them, rendered it.
class SharedSeries : public PartTest {
 protected:
  std::vector<std::string> series(int frames, int process) const {
    return {"render",   path("scene.toml"),
            "-o",       path("f.####.ppm"),
            "--frames", "1-" + std::to_string(frames),
            "--spp",    "8",
            "--claim",  "-q",
            "-t",       "1",
            "--stats",  "json:" + path("by" + std::to_string(process) + ".####.json")};
  }
  int rendered(const std::string& frame) const {
    int times = 0;
    for (const std::string& name : files())
      times += name.starts_with("by") && name.ends_with("." + frame + ".json") ? 1 : 0;
    return times;
  }
  static std::string number(int frame) {
    std::string digits = std::to_string(frame);
    return std::string(4 - digits.size(), '0') + digits;
  }
};

TEST_F(SharedSeries, NeedsASeriesOfFiles) {
  EXPECT_THAT(refused_run(render("a.exr", {"--claim"}), 2).err, HasSubstr("--frames is missing"));
}

/// By hand with BOULE_FRAMES=200. A killed process may have written its picture and not yet its
/// statistics, or be counted for a frame that another one renders again: one frame each.
TEST_F(SharedSeries, KilledProcessesLeaveEachFrameRenderedOnce) {
  const char* const wanted = std::getenv("BOULE_FRAMES");
  const int frames = wanted != nullptr ? std::atoi(wanted) : 24, processes = 8, killed = 3;
  small_scene();
  std::vector<std::unique_ptr<RunningProgram>> programs;
  programs.reserve(processes);
  for (int i = 0; i < processes; ++i)
    programs.push_back(std::make_unique<RunningProgram>(series(frames, i)));
  for (int i = 0; i < killed; ++i) {  // each when there are some more pictures
    while (!std::filesystem::exists(path("f." + number((i + 1) * frames / 6) + ".ppm")))
      std::this_thread::sleep_for(std::chrono::milliseconds(2));
    programs[static_cast<std::size_t>(i)]->send(SIGKILL);
  }
  for (int i = 0; i < processes; ++i) {
    const ProgramRun run = programs[static_cast<std::size_t>(i)]->finish();
    if (i >= killed) {
      EXPECT_EQ(run.exit_code, 0) << run.out;
    }
  }
  const ProgramRun alone =
      boule_run({"render", small_scene(), "-o", path("alone.ppm"), "--spp", "8", "-q"});
  ASSERT_EQ(alone.exit_code, 0);
  int without = 0;
  for (int i = 1; i <= frames; ++i) {
    EXPECT_EQ(read("f." + number(i) + ".ppm"), read("alone.ppm")) << i;
    EXPECT_LE(rendered(number(i)), 1) << i;
    without += rendered(number(i)) == 0 ? 1 : 0;
  }
  EXPECT_LE(without, killed);
  for (const std::string& name : files()) EXPECT_FALSE(name.ends_with(".claim")) << name;
}

}  // namespace
}  // namespace boule::test
