// boule view from the command line; what it serves is tested in tests/render/apps/view.
#include <arpa/inet.h>
#include <netinet/in.h>
#include <sys/socket.h>
#include <sys/stat.h>
#include <sys/un.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <csignal>
#include <cstdlib>
#include <memory>

#include "tests/render/apps/cli/program.h"
#include "tests/render/apps/cli/running_program.h"

namespace boule::test {
namespace {

using testing::HasSubstr;
using testing::MatchesRegex;

class View : public ProgramTest {};

constexpr const char* url_line = "http://127\\.0\\.0\\.1:[0-9]+/\\?token=[0-9a-f]{32}\n";

TEST_F(View, PrintsItsAddressAndEndsIdle) {
  const ProgramRun run = boule_run({"view", small_scene(), "--idle", "50ms"});
  EXPECT_EQ(run.exit_code, 0) << run.err;
  EXPECT_THAT(run.out, MatchesRegex(url_line));
}

/// From another machine, whose browser cannot open an address of this one.
TEST_F(View, TellsTheTunnelOfSsh) {
  ::setenv("SSH_CONNECTION", "198.51.100.9 53211 192.0.2.7 2222", 1);
  const ProgramRun run = boule_run({"view", small_scene(), "--idle", "50ms"});
  const ProgramRun open =
      boule_run({"view", small_scene(), "--listen", "0.0.0.0", "--idle", "50ms"});
  ::unsetenv("SSH_CONNECTION");
  const std::string port = run.out.substr(17, run.out.find('/', 17) - 17);
  EXPECT_THAT(run.err,
              HasSubstr("ssh -N -L " + port + ":127.0.0.1:" + port + " -p 2222 192.0.2.7\n"));
  EXPECT_EQ(open.exit_code, 0) << open.err;
  EXPECT_THAT(open.err, testing::Not(HasSubstr("ssh")));
}

TEST_F(View, EndsAtASignal) {
  for (const int signal : {SIGINT, SIGTERM}) {
    RunningProgram program({"view", small_scene()});
    ASSERT_TRUE(program.wait_for("?token="));
    program.send(signal);
    const ProgramRun run = program.finish();
    EXPECT_EQ(run.exit_code, 128 + signal);
    EXPECT_THAT(run.out, HasSubstr(signal == SIGINT ? "ended (SIGINT)" : "ended (SIGTERM)"));
  }
}

TEST_F(View, RefusesWhatItCannotShow) {
  refused_run({"view", path("nothing.toml")}, 3);
  refused_run({"view", write("broken.toml", "schema = 1\nsphere = 5\n")}, 3);
  refused_run({"view", small_scene(), "--color", "q"}, 2);
  refused_run({"view", small_scene(), "--listen", "somewhere"}, 2);
  refused_run({"view", small_scene(), "--port", "65536"}, 2);
  refused_run({"view", small_scene(), "--listen", "203.0.113.1"}, 1);
  refused_run({"view"}, 2);
}

/// All of this machine's addresses mean one that others can open.
TEST_F(View, TellsAnAddressThatCanBeOpened) {
  const ProgramRun run =
      boule_run({"view", small_scene(), "--listen", "0.0.0.0", "--idle", "100ms"});
  EXPECT_EQ(run.exit_code, 0) << run.err;
  ASSERT_TRUE(run.out.starts_with("http://")) << run.out;
  const std::string host = run.out.substr(7, run.out.rfind(':') - 7);
  sockaddr_in place{};
  place.sin_family = AF_INET;
  ASSERT_EQ(inet_pton(AF_INET, host.c_str(), &place.sin_addr), 1) << host;
  EXPECT_NE(place.sin_addr.s_addr, INADDR_ANY);
  const int own = socket(AF_INET, SOCK_STREAM, 0);
  EXPECT_EQ(bind(own, reinterpret_cast<const sockaddr*>(&place), sizeof place), 0) << host;
  close(own);
}

/// A socket in the file system: one that listens there, or connects to what does.
int at_socket(const std::string& file, int (*action)(int, const sockaddr*, socklen_t),
              int flags = 0) {
  sockaddr_un place{};
  place.sun_family = AF_UNIX;
  file.copy(place.sun_path, sizeof place.sun_path - 1);
  const int end = socket(AF_UNIX, SOCK_STREAM | flags, 0);
  if (action(end, reinterpret_cast<const sockaddr*>(&place), sizeof place) == 0) return end;
  close(end);
  return -1;
}

/// What a server at a socket in the file system answers, up to this text or the end.
std::string answer_at(const std::string& file, const std::string& request,
                      const std::string& last) {
  const int end = at_socket(file, connect);
  EXPECT_GE(end, 0);
  EXPECT_EQ(write(end, request.data(), request.size()), static_cast<ssize_t>(request.size()));
  std::string answer;
  std::array<char, 4096> part{};
  while (answer.find(last) == std::string::npos) {
    const ssize_t size = read(end, part.data(), part.size());
    if (size <= 0) break;
    answer.append(part.data(), static_cast<std::size_t>(size));
  }
  close(end);
  return answer;
}

TEST_F(View, ListensAtASocketFile) {
  const std::string file = path("view.sock");
  RunningProgram program({"view", small_scene(), "--socket", file, "--port", "8123"});
  std::string token;
  ASSERT_TRUE(program.wait_for("http://localhost:8123/?token="));
  ASSERT_TRUE(program.wait_until([&](const std::string& shown, std::size_t from) {
    token = shown.substr(from, 32);
    return token.size() == 32 ? from + 32 : std::string::npos;
  }));
  ASSERT_TRUE(program.wait_for("ssh -N -L 8123:" + file));
  struct stat found {};
  ASSERT_EQ(stat(file.c_str(), &found), 0);
  EXPECT_EQ(found.st_mode & 0777U, 0600U);
  const std::string head = " HTTP/1.1\r\nHost: localhost:8123\r\n";
  EXPECT_THAT(answer_at(file, "GET /?token=" + token + head + "\r\n", "</html>"),
              HasSubstr("</html>"));
  EXPECT_THAT(answer_at(file, "GET /" + head + "\r\n", "\r\n\r\n"), HasSubstr(" 403 "));
  const std::string upgrade =
      "Connection: Upgrade\r\nUpgrade: websocket\r\nSec-WebSocket-Version: 13\r\n"
      "Sec-WebSocket-Key: dGhlIHNhbXBsZSBub25jZQ==\r\n\r\n";
  EXPECT_THAT(answer_at(file, "GET /socket?token=" + token + head + upgrade, "\"state\""),
              testing::AllOf(HasSubstr(" 101 "), HasSubstr("\"state\"")));
  refused_run({"view", small_scene(), "--socket", file}, 1);  // it is in use
  program.send(SIGTERM);
  program.finish();
  EXPECT_NE(stat(file.c_str(), &found), 0);
}

TEST_F(View, TakesTheSocketOfAKilledProgram) {
  const std::string file = path("view.sock");
  {
    RunningProgram program({"view", small_scene(), "--socket", file});
    ASSERT_TRUE(program.wait_for("?token="));
    program.send(SIGKILL);
    program.finish();
  }
  const ProgramRun run = boule_run({"view", small_scene(), "--socket", file, "--idle", "50ms"});
  EXPECT_EQ(run.exit_code, 0) << run.err;
  refused_run({"view", small_scene(), "--socket", write("a_file", "kept")}, 1);
  EXPECT_EQ(read("a_file"), "kept");
  refused_run({"view", small_scene(), "--socket", std::string(200, 'x')}, 2);
  refused_run({"view", small_scene(), "--socket", file, "--open"}, 2);
}

/// Each finds what a killed program has left, and must not take it from the one that was faster.
TEST_F(View, OneOfManyHasTheSocket) {
  const std::string file = path("view.sock"), scene = small_scene();
  for (int round = 0; round < 4; ++round) {
    close(at_socket(file, bind));
    std::vector<std::unique_ptr<RunningProgram>> programs;
    for (int i = 0; i < 6; ++i) {
      programs.push_back(std::make_unique<RunningProgram>(
          std::vector<std::string>{"view", scene, "--socket", file}));
    }
    int serving = 0;
    for (const auto& program : programs) {
      if (program->wait_for("?token=")) {
        ++serving;
      } else {
        const ProgramRun run = program->finish();
        EXPECT_EQ(run.exit_code, 1);
        EXPECT_THAT(run.out, HasSubstr("view.sock.lock' is held by"));
      }
    }
    EXPECT_EQ(serving, 1);
    EXPECT_THAT(answer_at(file, "GET / HTTP/1.1\r\nHost: localhost\r\n\r\n", "\r\n\r\n"),
                HasSubstr(" 403 "));
    for (const auto& program : programs) program->send(SIGKILL);
  }
}

TEST_F(View, LeavesTheSocketOfABusyProgram) {
  const std::string file = path("busy.sock");
  const int busy = at_socket(file, bind);
  ASSERT_EQ(listen(busy, 0), 0);
  std::vector<int> waiting;  // it accepts nobody, until nobody can even wait
  while (waiting.empty() || waiting.back() >= 0)
    waiting.push_back(at_socket(file, connect, SOCK_NONBLOCK));
  ASSERT_EQ(errno, EAGAIN);
  struct stat before {
  }, after{};
  ASSERT_EQ(stat(file.c_str(), &before), 0);
  refused_run({"view", small_scene(), "--socket", file}, 1);
  ASSERT_EQ(stat(file.c_str(), &after), 0);
  EXPECT_EQ(after.st_ino, before.st_ino);
  for (const int end : waiting) close(end);
  close(busy);
}

/// Somebody has removed the first one's files, so that a second one could begin.
TEST_F(View, EndsWithoutTheSocketOfAnother) {
  const std::string file = path("view.sock"), lock = file + ".lock";
  RunningProgram first({"view", small_scene(), "--socket", file});
  ASSERT_TRUE(first.wait_for("?token="));
  unlink(file.c_str());
  unlink(lock.c_str());
  RunningProgram second({"view", small_scene(), "--socket", file});
  ASSERT_TRUE(second.wait_for("?token="));
  first.send(SIGTERM);
  EXPECT_EQ(first.finish().exit_code, 128 + SIGTERM);
  EXPECT_THAT(answer_at(file, "GET / HTTP/1.1\r\nHost: localhost\r\n\r\n", "\r\n\r\n"),
              HasSubstr(" 403 "));
  refused_run({"view", small_scene(), "--socket", file}, 1);
  second.send(SIGTERM);
  second.finish();
  EXPECT_NE(access(file.c_str(), F_OK), 0);
  EXPECT_NE(access(lock.c_str(), F_OK), 0);
}

class RenderedCamera : public ProgramTest {
 protected:
  std::string picture(const std::string& name, std::vector<std::string> options) const {
    options.insert(options.begin(), {"render", small_scene(), "-o", path(name), "-q"});
    const ProgramRun run = boule_run(options);
    EXPECT_EQ(run.exit_code, 0) << run.err;
    return read(name);
  }
};

TEST_F(RenderedCamera, IsTheOneOfTheCommandLine) {
  const std::string own = picture("own.ppm", {});
  EXPECT_EQ(picture("same.ppm", {"--camera", "eye = [0, 1, 5], look_at = [0, 0.8, 0]"}), own);
  const std::string other =
      picture("other.ppm", {"--camera",
                            "type = \"orthographic\", eye = [1, 1, 5], look_at = [0, "
                            "0.8, 0], height = 3"});
  EXPECT_NE(other, own);
  std::string text = read("scene.toml");
  const std::string before = "eye = [0.0, 1.0, 5.0]\nlook_at = [0.0, 0.8, 0.0]\n";
  text.replace(text.find(before), before.size(),
               "type = \"orthographic\"\neye = [1, 1, 5]\nlook_at = [0, 0.8, 0]\nheight = 3\n");
  const ProgramRun run =
      boule_run({"render", write("moved.toml", text), "-o", path("moved.ppm"), "-q"});
  EXPECT_EQ(run.exit_code, 0) << run.err;
  EXPECT_EQ(read("moved.ppm"), other);
}

TEST_F(RenderedCamera, MayBeFitted) {
  const std::string fitted =
      picture("fitted.ppm", {"--camera", "fit = true, direction = [0, 0, -1]"});
  EXPECT_NE(fitted, picture("own.ppm", {}));
  std::string text = read("scene.toml");
  const std::string before = "eye = [0.0, 1.0, 5.0]\nlook_at = [0.0, 0.8, 0.0]\n";
  text.replace(text.find(before), before.size(), "fit = true\ndirection = [0, 0, -1]\n");
  const ProgramRun run =
      boule_run({"render", write("moved.toml", text), "-o", path("moved.ppm"), "-q"});
  EXPECT_EQ(run.exit_code, 0) << run.err;
  EXPECT_EQ(read("moved.ppm"), fitted);
}

TEST_F(RenderedCamera, MayBeDistortedAndMove) {
  const std::string still = "eye = [0, 1, 5], look_at = [0, 0.8, 0]";
  const std::string own = picture("own.ppm", {"--camera", still});
  EXPECT_NE(picture("barrel.ppm", {"--camera", still + ", distortion = {file = \"" BOULE_SCENES
                                                       "/barrel.exr\"}"}),
            own);
  picture("moved.#.ppm", {"--frames", "1-2", "--camera",
                          "look_at = [0, 0.8, 0], key = [{frame = 1, eye = [0, 1, 5]}, "
                          "{frame = 3, eye = [0, 1, 9]}]"});
  EXPECT_EQ(read("moved.1.ppm"), own);
  EXPECT_EQ(read("moved.2.ppm"),
            picture("far.ppm", {"--camera", "eye = [0, 1, 7], look_at = [0, 0.8, 0]"}));
}

TEST_F(RenderedCamera, IsRefusedIfItIsNone) {
  for (const char* keys : {"eye = [0, 1, 5]", "fov = 3", "eye = 5, look_at = [0, 0, 0]", "}{",
                           "eye = [0, 1, 5], look_at = [0, 1, 5]", "roll = 1"}) {
    const ProgramRun run =
        refused_run({"render", small_scene(), "-o", path("x.ppm"), "--camera", keys}, 2);
    EXPECT_THAT(run.err, HasSubstr("--camera")) << keys;
  }
  const ProgramRun run =
      refused_run({"render", small_scene(), "-o", path("x.ppm"), "--camera", "eye = [0, 1, 5]"}, 2);
  EXPECT_THAT(run.err, HasSubstr("error: missing key 'look_at' (key '--camera')"));
}

TEST_F(RenderedCamera, ShadowsStartByAnEpsilonIfAsked) {
  const std::string own = picture("own.ppm", {});
  EXPECT_NE(picture("none.ppm", {"--shadow-epsilon", "none"}), own);
  EXPECT_EQ(picture("zero.ppm", {"--shadow-epsilon", "0"}), read("none.ppm"));
  EXPECT_NE(picture("large.ppm", {"--shadow-epsilon", "5"}), own);
  for (const char* text : {"-1", "nan", "inf", "much", ""})
    refused_run({"render", small_scene(), "-o", path("x.ppm"), "--shadow-epsilon", text}, 2);
}

}  // namespace
}  // namespace boule::test
