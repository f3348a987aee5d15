// Files that mean harm, or went through bad hands: each is refused in little time and memory, with
// the place of what is wrong; nothing is written, nothing left. What a single wrong key or number
// is answered with is in tests/scene_file.
#include <sys/resource.h>
#include <sys/socket.h>
#include <sys/stat.h>
#include <sys/un.h>
#include <sys/wait.h>
#include <unistd.h>

#include "tests/render/apps/cli/faults/hostile_files.h"
#include "tests/render/apps/cli/program.h"

namespace boule::test {
namespace {

#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)  // slower, and take their share
constexpr long most_seconds = 120;
constexpr std::size_t most_bytes = 1024 * mebibyte;
#else
constexpr long most_seconds = 20;
constexpr std::size_t most_bytes = 256 * mebibyte;
#endif

/// How a refusal begins, words of it, and the key it ends with, if it names one.
struct Refusal {
  std::string start, words, key;
};

/// Why the run is no such refusal, or an empty text.
std::string unlike(const ProgramRun& run, const Refusal& wanted) {
  const std::string end = wanted.key.empty() ? "\n" : " (key '" + wanted.key + "')\n";
  const auto lines = std::count(run.err.begin(), run.err.end(), '\n');
  const bool good = run.exit_code == 3 && run.err.starts_with(wanted.start + " error: ") &&
                    run.err.find(wanted.words) != std::string::npos && run.err.ends_with(end) &&
                    run.out.empty() && lines >= 1 && lines <= 3;
  if (good) return {};
  return "exit " + std::to_string(run.exit_code) + ": " + run.err.substr(0, 400) + "; wanted " +
         wanted.start + " error: ..." + wanted.words + "..." + end;
}

class HostileFiles : public ProgramTest {
 protected:
  /// Runs a program in a child of its own, so that its memory and its seconds of the processor can
  /// be told from others'.
  void expect_refused_by(const std::string& program, const std::vector<std::string>& arguments,
                         const Refusal& wanted) const {
    const auto before = files();
    const pid_t child = ::fork();
    if (child == 0) {
      const std::string problem = unlike(run_program(program, {arguments, {}}), wanted);
      if (!problem.empty()) std::fprintf(stderr, "%s", problem.c_str());
      ::_exit(problem.empty() ? 0 : 1);
    }
    int status = 0;
    rusage used{};
    ::wait4(child, &status, 0, &used);
    EXPECT_EQ(status, 0) << wanted.start;
    EXPECT_EQ(files(), before);
    EXPECT_LT(used.ru_utime.tv_sec + used.ru_stime.tv_sec, most_seconds) << wanted.start;
    EXPECT_LT(static_cast<std::size_t>(used.ru_maxrss) * 1024, most_bytes) << wanted.start;
  }
  void expect_refused(const std::string& scene, const Refusal& wanted) const {
    expect_refused_by(BOULE_PROGRAM, {"render", scene, "-o", path("out.png"), "-q"}, wanted);
  }
  void expect_rays_refused(const std::string& rays, const std::string& words) const {
    const std::string scene = small_scene();
    expect_refused_by(BOULE_PROGRAM, {"trace", scene, "--rays", rays, "-o", path("hits.npy"), "-q"},
                      {rays + ":", words, ""});
  }

  /// A scene with this data file, and where and under which key it is refused.
  std::pair<std::string, Refusal> scene_of(const std::string& file) const {
    const bool spheres = file.ends_with(".npy"), lens = file.ends_with(".lens");
    const std::string text = spheres ? spheres_of(file) : lens ? lens_of(file) : sky_of(file);
    const std::string scene = write(file + ".toml", text);
    return {scene,
            {scene + ":3:8:", "'" + file + "': ",
             spheres ? "spheres[0].file"
             : lens  ? "camera.file"
                     : "background.file"}};
  }
};

class HostileScenes : public HostileFiles, public testing::WithParamInterface<HostileScene> {};

TEST_P(HostileScenes, AreRefusedInLittleTimeAndMemory) {
  const HostileScene& hostile = GetParam();
  const std::string scene = write(hostile.file, hostile.text());
  expect_refused(scene, {scene + ":" + hostile.place + ":", hostile.words, hostile.key});
}

class HostileDataFiles : public HostileFiles, public testing::WithParamInterface<HostileData> {};

TEST_P(HostileDataFiles, AreRefusedInLittleTimeAndMemory) {
  const HostileData& hostile = GetParam();
  write(hostile.file, hostile.bytes());
  auto [scene, refusal] = scene_of(hostile.file);
  refusal.words = hostile.words;
  // "line 3: WORDS" is told at that line of a lens.
  if (const std::string words = hostile.words; words.starts_with("line ")) {
    const std::size_t colon = words.find(": ");
    refusal.start = path(hostile.file) + ":" + words.substr(5, colon - 4);
    refusal.words = words.substr(colon + 2);
  }
  expect_refused(scene, refusal);
}

class HostileRays : public HostileFiles, public testing::WithParamInterface<HostileData> {};

TEST_P(HostileRays, AreRefusedInLittleTimeAndMemory) {
  expect_rays_refused(write(GetParam().file, GetParam().bytes()), GetParam().words);
}

const auto name_of = [](const auto& hostile) { return std::string(hostile.param.name); };
INSTANTIATE_TEST_SUITE_P(Toml, HostileScenes, testing::ValuesIn(hostile_toml()), name_of);
INSTANTIATE_TEST_SUITE_P(Nff, HostileScenes, testing::ValuesIn(hostile_nff()), name_of);
INSTANTIATE_TEST_SUITE_P(Npy, HostileDataFiles, testing::ValuesIn(hostile_arrays()), name_of);
INSTANTIATE_TEST_SUITE_P(Others, HostileDataFiles, testing::ValuesIn(hostile_lenses_and_pictures()),
                         name_of);
INSTANTIATE_TEST_SUITE_P(Npy, HostileRays, testing::ValuesIn(hostile_rays()), name_of);

/// What is no regular file: as the scene, as the rays, and as each kind of data file.
TEST_F(HostileFiles, NonFilesAreRefusedEverywhere) {
  ASSERT_EQ(::mkfifo(path("fifo").c_str(), 0600), 0);
  std::filesystem::create_directory(path("folder"));
  std::filesystem::create_symlink("itself", path("itself"));
  sockaddr_un address{};
  address.sun_family = AF_UNIX;
  path("socket").copy(address.sun_path, sizeof address.sun_path - 1);
  const int socket = ::socket(AF_UNIX, SOCK_STREAM, 0);
  ASSERT_EQ(::bind(socket, reinterpret_cast<const sockaddr*>(&address), sizeof address), 0);
  const std::pair<std::string, std::string> kinds[] = {
      {path("fifo"), "it is a FIFO, expected a regular file"},
      {path("folder"), "it is a directory, expected a regular file"},
      {path("socket"), "it is a socket, expected a regular file"},
      {"/dev/zero", "it is a device, expected a regular file"},
      {"/dev/urandom", "it is a device, expected a regular file"},
      {path("itself"), "Too many levels"},
      {path("nowhere"), "No such file or directory"},
      {"/proc/self/mem/x", "Not a directory"}};
  int number = 0;
  for (const auto& [target, words] : kinds) {
    for (const std::string extension : {"toml", "nff", "npy", "lens", "exr", "png"}) {
      const std::string link = "link" + std::to_string(++number) + "." + extension;
      std::filesystem::create_symlink(target, path(link));
      if (extension == "toml" || extension == "nff") {
        expect_refused(path(link), {path(link) + ":", "cannot read it: " + words, ""});
        continue;
      }
      auto [scene, refusal] = scene_of(link);
      refusal.words += "cannot read it: " + words;
      expect_refused(scene, refusal);
      if (extension == "npy") expect_rays_refused(path(link), "cannot read it: " + words);
    }
  }
  ::close(socket);
}

/// Permissions do not bind root: it becomes somebody else.
TEST_F(HostileFiles, WhatMayNotBeReadIsRefused) {
  const std::vector<std::string> nobody = {"--reuid=65534", "--regid=65534", "--clear-groups",
                                           "--inh-caps=-all", BOULE_PROGRAM};
  const bool root = ::geteuid() == 0;
  std::filesystem::permissions(path(""), std::filesystem::perms{0777});
  const auto run = [&](const std::vector<std::string>& arguments) {
    std::vector<std::string> all = root ? nobody : std::vector<std::string>{};
    all.insert(all.end(), arguments.begin(), arguments.end());
    return std::pair{root ? "/usr/bin/setpriv" : BOULE_PROGRAM, all};
  };
  const auto [program, version] = run({"--version"});
  if (run_program(program, {version, {}}).exit_code != 0)
    GTEST_SKIP() << "cannot become somebody else who may start the program";
  for (const std::string name : {"a.toml", "a.nff", "a.npy", "a.lens", "a.exr", "a.png"}) {
    ASSERT_EQ(::chmod(write(name, "secret").c_str(), 0), 0);
    const bool is_scene = name.ends_with(".toml") || name.ends_with(".nff");
    auto [scene, refusal] =
        is_scene ? std::pair{path(name), Refusal{path(name) + ":", "", ""}} : scene_of(name);
    refusal.words += "cannot read it: Permission denied";
    expect_refused_by(program, run({"render", scene, "-o", path("out.png"), "-q"}).second, refusal);
  }
}

TEST_F(HostileFiles, ByteOrderMarksAndWindowsLinesWork) {
  const std::string mark = "\xef\xbb\xbf";
  write("d.lens", mark + "# flat glass\r\n30 4 1.5 20\r\n-30 0 1 20\r\n");
  const std::string toml = write("a.toml", mark + "schema = 1\r\n[[sphere]]\r\nradius = 2\r\n");
  const std::string lens = write("b.toml", mark + lens_of("d.lens"));
  std::string text = mark + nff_view + "s 0 0 0 1\n";
  for (std::size_t i = 0; (i = text.find('\n', i)) != std::string::npos; i += 2)
    text.replace(i, 1, "\r\n");
  for (const std::string& scene : {toml, lens, write("c.nff", text)}) {
    const ProgramRun run = boule_run({"info", scene});
    EXPECT_EQ(run.exit_code, 0) << run.err;
  }
}

}  // namespace
}  // namespace boule::test
