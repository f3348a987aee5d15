// Files of other programs, by readers in place of Python: scripts of the shell.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <signal.h>
#include <sys/stat.h>

#include <array>
#include <cerrno>
#include <cstdio>
#include <cstring>
#include <limits>

#include "render/files/particle_file/bridge/boule_read.h"
#include "render/files/particle_file/bridge/bridge_reader.h"
#include "tests/render/files/particle_file/read_text.h"

namespace boule {
namespace {

using testing::AllOf;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::Not;

/// The first answer of a reader that has so many frames.
std::string head(int frames = 1) {
  return "printf 'boule-read 1\\nlibrary fake 2\\nframes " + std::to_string(frames) + "\\n\\n'\n";
}

/// Doubles as printf of the shell writes them.
std::string doubles(const std::vector<double>& values) {
  std::string text;
  for (const double value : values) {
    std::array<unsigned char, sizeof value> bytes{};
    std::memcpy(bytes.data(), &value, sizeof value);
    for (const unsigned char byte : bytes) {
      std::array<char, 8> octal{};
      std::snprintf(octal.data(), octal.size(), "\\%03o", static_cast<unsigned>(byte));
      text += octal.data();
    }
  }
  return text;
}

const std::string one_particle =
    "printf 'particles 1\\npositions\\n\\n" + doubles({1, 2, 3}) + "'\n";

class Bridge : public testing::Test {
 protected:
  /// Files are read by this script.
  Bridge() { test::write_bytes(file(), "bytes"); }
  ~Bridge() override { set_bridge_python("/usr/bin/python3"); }
  void read_by(const std::string& script) {
    test::write_bytes(path("reader"), "#!/bin/sh\necho $$ > " + path("pid") + "\n" + script);
    chmod(path("reader").c_str(), 0755);
    set_bridge_python(path("reader"));
  }
  std::string path(const std::string& name) const { return (folder_.path() / name).string(); }
  std::string file() const { return path("run.xtc"); }

  Result<ParticleFrame> frame(const ParticleFileOptions& options = {}) const {
    auto opened = ParticleFile::open(file(), options);
    if (!opened) return opened.error();
    return opened.value().read();
  }
  /// What is wrong; nobody is left who reads.
  std::string error() const {
    const auto read = frame();
    EXPECT_TRUE(is_over());
    return read ? "no error" : format_diagnostic(read.error());
  }
  bool is_over() const {
    const int process = std::stoi(test::read_bytes(path("pid")));
    return kill(process, 0) != 0 && errno == ESRCH;
  }

 private:
  test::TempDir folder_;
};

TEST_F(Bridge, NamesAreThoseOfTheTable) {
  for (const char* name : {"a.xtc", "a.H5", "POSCAR", "in/CONTCAR.2", "a.vtp", "run.traj"})
    EXPECT_TRUE(is_particle_name(name)) << name;
  for (const char* name : {"xtc", "a.poscarx", "a.toml", "vtk", "a.xyz.bak", "a|"})
    EXPECT_FALSE(is_particle_name(name)) << name;
  EXPECT_THAT(std::string(boule_read_script), HasSubstr("FORMATS = \"\"\"\n"));
}

TEST_F(Bridge, FramesBecomeWhatIsTold) {
  read_by(head(3) +
          "while read word number; do\n"
          "printf 'particles 2\\npositions\\nnumber charge\\ntext 2 6 name\\n"
          "text 1 4 resname\\ncell 1 0 0 0 2 0 0 0 3 0.5 0 0\\nperiodic 1 0 1\\n"
          "time %s.5\\nangstrom 10\\nnote told\\n\\n' $number\n"
          "printf '" +
          doubles({1, 2, 3, 4, 5, 6}) + doubles({-1, 0.25}) +
          "'\n"
          "printf 'CA\\nNA\\n\\001\\0\\0\\0\\0\\0\\0\\0'\n"
          "printf 'ALA\\n\\0\\0\\0\\0\\0\\0\\0\\0'\ndone\n");
  auto opened = ParticleFile::open(file());
  ASSERT_TRUE(opened.ok()) << format_diagnostic(opened.error());
  EXPECT_EQ(opened.value().frames(), 3U);
  EXPECT_EQ(opened.value().format(), "library");
  for (const long number : {2, 0}) {
    const auto read = opened.value().read(number);
    ASSERT_TRUE(read.ok()) << format_diagnostic(read.error());
    const ParticleFrame& one = read.value();
    EXPECT_EQ(one.time, static_cast<double>(number) + 0.5);
    EXPECT_THAT(one.positions, ElementsAre(Vec3d{1, 2, 3}, Vec3d{4, 5, 6}));
    EXPECT_THAT(one.numbers.at(0).values, ElementsAre(-1, 0.25));
    EXPECT_THAT(one.texts.at(0).texts, ElementsAre("CA", "NA"));
    EXPECT_THAT(one.texts.at(0).indices, ElementsAre(1, 0));
    EXPECT_THAT(one.species->texts, ElementsAre("N", "C"));
    EXPECT_EQ(one.cell->b, (Vec3d{0, 2, 0}));
    EXPECT_EQ(one.cell->origin, (Vec3d{0.5, 0, 0}));
    EXPECT_THAT(one.cell->periodic, ElementsAre(true, false, true));
    EXPECT_EQ(one.length_in_angstrom, 10);
    EXPECT_THAT(one.notes, testing::Contains("told"));
  }
  opened = Diagnostic::of("closed");
  EXPECT_TRUE(is_over());
}

TEST_F(Bridge, UnwantedColumnsAreNamedOnly) {
  read_by(head() +
          "read line\n"
          "printf 'particles 1\\npositions\\nnumber q\\nnumber w\\nunread mass\\nnote %s %s\\n\\n' "
          "$5 $6\n"
          "printf '" +
          doubles({1, 2, 3, 4, 5}) + "'\n");
  const auto read = frame({.wanted = std::vector<std::string>{"w"}});
  ASSERT_TRUE(read.ok()) << format_diagnostic(read.error());
  EXPECT_EQ(read.value().numbers.at(0).name, "w");
  EXPECT_THAT(read.value().numbers.at(0).values, ElementsAre(5));
  EXPECT_THAT(read.value().unread, testing::UnorderedElementsAre("q", "mass"));
  EXPECT_THAT(read.value().notes, testing::Contains("only w"));  // what the reader is asked for
}

TEST_F(Bridge, TopologyTellsKindsAndMustFit) {
  read_by(head() + "read line\n" + one_particle);
  test::write_bytes(path("kinds.xyz"), "1\n\nFe 0 0 0\n");
  const auto read = frame({.topology = path("kinds.xyz")});
  ASSERT_TRUE(read.ok()) << format_diagnostic(read.error());
  EXPECT_THAT(read.value().species->texts, ElementsAre("Fe"));
  EXPECT_EQ(read.value().positions.at(0), (Vec3d{1, 2, 3}));
  test::write_bytes(path("kinds.xyz"), "2\n\nFe 0 0 0\nFe 1 0 0\n");
  const auto other = frame({.topology = path("kinds.xyz")});
  ASSERT_FALSE(other.ok());
  EXPECT_EQ(other.error().message, "it has 2 particles, the file has 1");
  EXPECT_EQ(other.error().key, "topology");
  const auto without = frame();
  ASSERT_TRUE(without.ok());
  EXPECT_THAT(without.value().notes, testing::Contains(HasSubstr("--topology")));
}

TEST_F(Bridge, BondsAreOfThoseThatAreThere) {
  const std::string two = "read line\nprintf 'particles 2\\npositions\\nbonds 2\\n\\n" +
                          doubles({1, 2, 3, 4, 5, 6}) + "'\n";
  read_by(head() + two + "printf '\\001\\0\\0\\0\\0\\0\\0\\0\\0\\0\\0\\0\\001\\0\\0\\0'\n");
  const auto read = frame({.most_bonded = 2});
  ASSERT_TRUE(read.ok()) << format_diagnostic(read.error());
  EXPECT_THAT(read.value().bonds, ElementsAre(ParticleBond{0, 1}));
  EXPECT_TRUE(read.value().lists_all_bonds);
  EXPECT_THAT(frame({.most_bonded = 1}).value().bonds, testing::IsEmpty());
  read_by(head() + two + "printf '\\001\\0\\0\\0\\0\\0\\0\\0\\002\\0\\0\\0\\001\\0\\0\\0'\n");
  EXPECT_THAT(error(), HasSubstr("the answer of boule-read is not understood: 'bonds'"));
  // A topology has them for the frames of another file.
  read_by(head() + two + "printf '\\001\\0\\0\\0\\0\\0\\0\\0\\0\\0\\0\\0\\001\\0\\0\\0'\n");
  test::write_bytes(path("run.xyz"), "2\n\nA 0 0 0\nA 1 0 0\n");
  auto run = ParticleFile::open(path("run.xyz"), {.most_bonded = 2, .topology = file()});
  ASSERT_TRUE(run.ok()) << format_diagnostic(run.error());
  EXPECT_THAT(run.value().read().value().bonds, ElementsAre(ParticleBond{0, 1}));
}

TEST_F(Bridge, ErrorsOfReadersAreTold) {
  read_by("echo noise >&2\nprintf 'error an XTC trajectory: needs MDAnalysis\\n\\n'\n");
  EXPECT_THAT(error(), AllOf(HasSubstr("run.xtc: error: an XTC trajectory: needs MDAnalysis"),
                             Not(HasSubstr("noise"))));
  read_by(head(2) + "read line\nprintf 'error the frame is bad\\n\\n'\nread line\n" + one_particle);
  auto opened = ParticleFile::open(file());
  ASSERT_TRUE(opened.ok());
  EXPECT_EQ(opened.value().read(0).error().message, "the frame is bad");
  EXPECT_TRUE(opened.value().read(1).ok());
}

TEST_F(Bridge, ReadersThatEndAreOneError) {
  read_by("echo first >&2\necho 'the last line' >&2\nexit 3\n");
  EXPECT_THAT(error(), HasSubstr("it ended: the last line"));
  read_by("kill -SEGV $$\n");
  EXPECT_THAT(error(), HasSubstr("it was ended by signal 11"));
  read_by(head() + "exit 0\n");
  EXPECT_THAT(error(), HasSubstr("it ended"));
  // It closes the pipe in the middle, and stays.
  read_by(head() + "read line\nprintf 'particles 9\\npositions\\n\\nabc'\nexec >&-\nsleep 1000\n");
  EXPECT_THAT(error(), HasSubstr("it ended"));
}

TEST_F(Bridge, BabbleIsNotUnderstood) {
  read_by("echo 'Welcome to the library'\nsleep 1000\n");
  EXPECT_THAT(error(), HasSubstr("is not understood: 'Welcome to the library'"));
  read_by("exec cat /dev/zero\n");
  EXPECT_THAT(error(), HasSubstr("its lines have no end"));
  read_by("exec yes\n");
  EXPECT_THAT(error(), HasSubstr("is not understood: 'y'"));
  read_by(head() + "exec yes note more\n");
  EXPECT_THAT(error(), HasSubstr("is not understood: 'note more'"));
  read_by("cat /dev/zero >&2 &\n" + head() + "read line\n" + one_particle + "sleep 1000\n");
  EXPECT_EQ(error(), "no error");  // errors without end are read and forgotten
  for (const char* line : {"particles -1", "cell 1 2", "periodic 1 1 1", "text 9 3 a", "time nan",
                           "angstrom 0", "bonds x", "frames 2"}) {
    read_by(head() + "read line\nprintf '" + line + "\\n\\n'\nsleep 1000\n");
    EXPECT_THAT(error(), HasSubstr("is not understood")) << line;
  }
}

TEST_F(Bridge, PromisesAreHeldAgainstMemory) {
  for (const char* count : {"1000000000000", "18446744073709551615"}) {
    read_by(head() + "read line\nprintf 'particles " + count + "\\npositions\\n\\n'\nsleep 1000\n");
    EXPECT_THAT(error(), HasSubstr(std::string(count) + " particles need "));
  }
  read_by(head() +
          "read line\nprintf 'particles 1\\ntext 1 9000000000000000000 a\\n\\n'\nsleep 99\n");
  EXPECT_THAT(error(), HasSubstr("1 particles need "));
}

TEST_F(Bridge, ValuesMustBeFinite) {
  const double inf = std::numeric_limits<double>::infinity();
  read_by(head() + "read line\nprintf 'particles 1\\npositions\\n\\n" + doubles({1, inf, 3}) +
          "'\n");
  EXPECT_THAT(error(), HasSubstr("particle 1 is at no finite position"));
  read_by(head() + "read line\nprintf 'particles 1\\npositions\\nnumber q\\n\\n" +
          doubles({1, 2, 3, inf}) + "'\n");
  EXPECT_THAT(error(), HasSubstr("of particle 1: expected a finite number (key 'q')"));
  EXPECT_TRUE(frame({.lenient = true}).ok());
}

TEST_F(Bridge, FilesWithoutPositionsAreTopologies) {
  read_by(head() +
          "read line\nprintf 'particles 1\\nspecies 1 3 element\\n\\nFe\\n\\0\\0\\0\\0'\n");
  EXPECT_THAT(error(), HasSubstr("it has no positions"));
  read_by(head() +
          "read line\nprintf 'particles 1\\nspecies 1 3 element\\n\\nFe\\n\\001\\0\\0\\0'\n");
  EXPECT_THAT(error(), HasSubstr("is not understood"));  // an index beyond the texts
}

TEST_F(Bridge, MissingPythonIsOneError) {
  set_bridge_python("/nowhere/python3");
  const auto read = frame();
  ASSERT_FALSE(read.ok());
  EXPECT_THAT(read.error().message,
              AllOf(HasSubstr("'/nowhere/python3' does not start"), HasSubstr("BOULE_PYTHON")));
}

}  // namespace
}  // namespace boule
