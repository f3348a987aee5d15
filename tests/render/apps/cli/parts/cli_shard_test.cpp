// --shard and merge: a picture in parts.
#include "tests/render/apps/cli/parts/part_program.h"

namespace boule::test {
namespace {

using testing::HasSubstr;

class Shards : public PartTest {
 protected:
  std::string shard(int k, int n, const std::vector<std::string>& more = {},
                    const std::string& spp = "20") const {
    const std::string name = "p" + std::to_string(k) + "of" + std::to_string(n) + ".film";
    std::vector<std::string> words = {"--shard", std::to_string(k) + "/" + std::to_string(n)};
    words.insert(words.end(), more.begin(), more.end());
    const ProgramRun run = boule_run(render(name, words, spp));
    EXPECT_EQ(run.exit_code, 0) << run.err;
    return path(name);
  }
  std::vector<std::string> merge(const std::vector<std::string>& films) const {
    std::vector<std::string> words = {"merge", "-q", "-o", path("merged.exr")};
    words.insert(words.end(), films.begin(), films.end());
    return words;
  }
};

TEST_F(Shards, MergedShardsMatchOneRun) {
  const std::string whole = whole_picture();
  for (const int n : {1, 2, 3, 40}) {
    std::vector<std::string> films;
    for (int k = n; k >= 1; --k)  // in any order, on any number of threads
      films.push_back(shard(k, n, {"-t", std::to_string(k % 3 + 1)}));
    const ProgramRun run = boule_run(merge(films));
    EXPECT_EQ(run.exit_code, 0) << run.err;
    EXPECT_EQ(read("merged.exr"), whole) << n;
  }
}

TEST_F(Shards, CropsAndOtherFormatsToo) {
  const std::vector<std::string> base = {"render", small_scene(), "--size", "97x61",    "--spp",
                                         "4",      "-q",          "--crop", "5,6,80,50"};
  const auto with = [&](const std::vector<std::string>& more) {
    std::vector<std::string> words = base;
    words.insert(words.end(), more.begin(), more.end());
    return boule_run(words).exit_code;
  };
  ASSERT_EQ(with({"-o", path("a.film"), "--shard", "1/2"}), 0);
  ASSERT_EQ(with({"-o", path("b.film"), "--shard", "2/2"}), 0);
  for (const char* const extension : {".exr", ".png", ".jpg", ".ppm"}) {
    const std::string whole = std::string("whole") + extension,
                      merged = "merged" + std::string(extension);
    ASSERT_EQ(with({"-o", path(whole)}), 0);
    const ProgramRun run =
        boule_run({"merge", path("a.film"), path("b.film"), "-q", "-o", path(merged)});
    EXPECT_EQ(run.exit_code, 0) << run.err;
    EXPECT_EQ(read(merged), read(whole)) << extension;
  }
}

/// Each pixel with the samples that its noise needs: no shard knows the pixels of the others.
TEST_F(Shards, PicturesWhoseNoiseIsAskedForToo) {
  ASSERT_EQ(boule_run(render_noise("whole.exr")).exit_code, 0);
  std::vector<std::string> films;
  for (const std::string shard : {"1/3", "2/3", "3/3"}) {
    const std::string film = "p" + shard.substr(0, 1) + ".film";
    films.push_back(path(film));
    ASSERT_EQ(boule_run(render_noise(film, {"--shard", shard})).exit_code, 0);
  }
  const ProgramRun run = boule_run(merge(films));
  EXPECT_EQ(run.exit_code, 0) << run.err;
  EXPECT_EQ(read("merged.exr"), read("whole.exr"));
}

TEST_F(Shards, PicturesOfBondsToo) {
  ASSERT_EQ(boule_run(render_bonds("whole.exr")).exit_code, 0);
  std::vector<std::string> films;
  for (const std::string shard : {"1/3", "2/3", "3/3"}) {
    const std::string film = "b" + shard.substr(0, 1) + ".film";
    films.push_back(path(film));
    ASSERT_EQ(boule_run(render_bonds(film, {"--shard", shard})).exit_code, 0);
  }
  const ProgramRun run = boule_run(merge(films));
  EXPECT_EQ(run.exit_code, 0) << run.err;
  EXPECT_EQ(read("merged.exr"), read("whole.exr"));
}

/// Edges, too: a block needs the centres of the pixels around it, which it renders itself.
TEST_F(Shards, AntialiasedPicturesToo) {
  const auto words = [&](const std::string& output, const std::vector<std::string>& more) {
    std::vector<std::string> all = {"render", small_scene(), "-o",    path(output),
                                    "--size", "97x61",       "--aa",  "8",
                                    "--tile", "16",          "--aov", "samples"};
    all.insert(all.end(), more.begin(), more.end());
    return all;
  };
  ASSERT_EQ(boule_run(words("whole.exr", {})).exit_code, 0);
  std::vector<std::string> films;
  for (const std::string shard : {"1/3", "2/3", "3/3"}) {
    const std::string film = "e" + shard.substr(0, 1) + ".film";
    films.push_back(path(film));
    ASSERT_EQ(boule_run(words(film, {"--shard", shard})).exit_code, 0);
  }
  const ProgramRun run = boule_run(merge(films));
  EXPECT_EQ(run.exit_code, 0) << run.err;
  EXPECT_EQ(read("merged.exr"), read("whole.exr"));
}

/// Every second block along the Morton curve is every second column.
TEST_F(Shards, MissingAndDoubledBlocksAreNamed) {
  const std::string a = shard(1, 2), b = shard(2, 2);
  EXPECT_THAT(refused_run(merge({b}), 3).err,
              HasSubstr("do not make a picture: pixels 0,0,16,61 are missing"));
  EXPECT_THAT(refused_run(merge({a, b, a}), 3).err,
              HasSubstr("do not make a picture: pixels 0,0,16,61 are there twice"));
}

TEST_F(Shards, FilmsOfOtherPicturesAreRefused) {
  const std::string a = shard(1, 2), b = shard(2, 2, {}, "21");
  const ProgramRun run = refused_run(merge({a, b}), 3);
  EXPECT_THAT(run.err, HasSubstr("p2of2.film: error: has --spp 21, not 20, as "));
  EXPECT_THAT(refused_run(merge({path("none.film")}), 3).err, HasSubstr("none.film"));
  write("text.film", "no film");
  EXPECT_THAT(refused_run(merge({a, path("text.film")}), 3).err, HasSubstr("no film file"));
}

TEST_F(Shards, FormatThatCannotHoldItIsRefused) {
  const std::string a = shard(1, 1);
  EXPECT_THAT(refused_run({"merge", a, "-o", path("a.png")}, 2).err, HasSubstr("extra channels"));
  EXPECT_THAT(refused_run({"merge", a, "-o", path("a.xyz")}, 2).err, HasSubstr("extension"));
  EXPECT_THAT(refused_run({"merge", a, "-o", a}, 2).err, HasSubstr("extension"));
  EXPECT_THAT(refused_run(render("a.exr", {"--shard", "1/2"}), 2).err, HasSubstr(".film"));
  EXPECT_THAT(refused_run(render("a.film", {"--shard", "3/2"}), 2).err, HasSubstr("K/N"));
}

/// A shard that was stopped goes on, and is no other shard.
TEST_F(Shards, HaveCheckpointsToo) {
  const std::vector<std::string> saved = {"--checkpoint", path("run.film") + ",10ms"};
  std::vector<std::string> stopped = render("p.film", saved, "100000");
  for (const char* word : {"--shard", "1/2", "--time-limit", "100ms"}) stopped.emplace_back(word);
  EXPECT_EQ(boule_run(stopped).exit_code, 1);
  EXPECT_THAT(refused_run(merge({path("run.film")}), 3).err, HasSubstr("are missing"));
  std::vector<std::string> other = render("p.film", saved, "100000");
  for (const char* word : {"--shard", "2/2", "--resume"}) other.emplace_back(word);
  EXPECT_THAT(refused_run(other, 3).err, HasSubstr("has --shard 1/2, not 2/2"));
}

/// srun without MPI: N copies would write one file.
TEST_F(Shards, CopiesUnderSrunMustShareTheWork) {
  const std::vector<std::string> step = {"SLURM_PROCID=1", "SLURM_STEP_ID=0", "SLURM_NTASKS=4",
                                         "SLURM_STEP_NUM_TASKS=4"};
  const std::vector<std::string> frames = {"--frames", "1-2"};
  EXPECT_THAT(refused_run(render("a.exr"), 2, step).err,
              HasSubstr("srun started 4 copies of this command"));
  EXPECT_THAT(refused_run(render("a.##.exr", frames), 2, step).err,
              HasSubstr("--claim or srun --mpi=pmix"));
  for (const auto& [output, words] :
       {std::pair{"a.film", std::vector<std::string>{"--shard", "2/4"}},
        std::pair{"a.##.exr", std::vector<std::string>{"--frames", "1-2", "--claim"}},
        std::pair{"a.exr", std::vector<std::string>{"--mpi", "never"}}}) {
    const ProgramRun run = boule_run(render(output, words, "1"), step);
    EXPECT_EQ(run.exit_code, 0) << run.err;
  }
  const ProgramRun batch = boule_run(render("a.exr"), {"SLURM_PROCID=0", "SLURM_NTASKS=4"});
  EXPECT_EQ(batch.exit_code, 0) << batch.err;
}

/// What a share has when it is stopped, and the whole picture of what all have.
TEST_F(Shards, UnfinishedFilmGivesAMarkedPicture) {
  std::vector<std::string> stopped = render("a.film", {}, "100000");
  for (const char* word : {"--shard", "1/2", "--partial", "--time-limit", "300ms"})
    stopped.emplace_back(word);
  const ProgramRun part = boule_run(stopped);
  EXPECT_EQ(part.exit_code, 0) << part.err;
  EXPECT_THAT(part.err, HasSubstr("a.film: partial, "));
  std::vector<std::string> rest = render("b.film", {}, "100000");
  for (const char* word : {"--shard", "2/2", "--partial", "--time-limit", "300ms"})
    rest.emplace_back(word);
  ASSERT_EQ(boule_run(rest).exit_code, 0);
  const ProgramRun run = boule_run(merge({path("a.film"), path("b.film")}));
  EXPECT_EQ(run.exit_code, 0) << run.err;
  EXPECT_THAT(run.err, HasSubstr("merged.exr: partial, "));
  EXPECT_THAT(run.err, HasSubstr(" % of its samples, of 2 films\n"));
}

}  // namespace
}  // namespace boule::test
