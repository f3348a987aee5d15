#include "render/files/particle_file/particle_file.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>

#include "render/files/particle_file/frame/particle_format.h"
#include "tests/render/files/particle_file/read_text.h"

namespace boule {
namespace {

using test::particle_error;
using test::read_particles;
using testing::HasSubstr;

const std::string three_frames = "1\none\nA 1 0 0\n1\ntwo\nA 2 0 0\n1\nthree\nA 3 0 0\n";

TEST(ParticleFile, KnowsFormatsByTheirEnding) {
  EXPECT_TRUE(is_particle_name("run.xyz"));
  EXPECT_TRUE(is_particle_name("folder.d/RUN.XYZ.gz"));
  EXPECT_TRUE(is_particle_name("run.extxyz.zst"));
  EXPECT_TRUE(is_particle_name("data.film"));
  EXPECT_TRUE(is_particle_name("in/dump.melt.gz"));
  EXPECT_FALSE(is_particle_name("scene.toml"));
  EXPECT_FALSE(is_particle_name("data.toml"));
  EXPECT_FALSE(is_particle_name("dump.npy"));
  EXPECT_FALSE(is_particle_name("run"));
  EXPECT_FALSE(is_particle_name("xyz"));
  EXPECT_FALSE(is_particle_name("run.xyz/picture.png"));
  EXPECT_FALSE(is_particle_name(""));
}

TEST(ParticleFile, FormatsAndEndingsAreUnique) {
  std::vector<std::string_view> names = particle_formats(), endings;
  for (const ParticleFormat& format : all_particle_formats()) {
    for (const std::string_view ending : format.endings) {
      if (!ending.empty()) endings.push_back(ending);
    }
  }
  for (std::vector<std::string_view>* list : {&names, &endings}) {
    std::sort(list->begin(), list->end());
    EXPECT_EQ(std::adjacent_find(list->begin(), list->end()), list->end());
  }
  for (const std::string_view ending : endings) {
    EXPECT_THAT(known_particle_endings(), HasSubstr("." + std::string(ending)));
  }
}

TEST(ParticleFile, KnowsFormatsByTheirContent) {
  EXPECT_TRUE(read_particles("conf", three_frames).ok());
  EXPECT_TRUE(read_particles("data.run", three_frames).ok());
  EXPECT_THAT(particle_error("conf", "hello\n"),
              testing::AllOf(HasSubstr("expected one of ."), HasSubstr(" .xyz ")));
  EXPECT_THAT(particle_error("conf", ""), HasSubstr("neither its ending nor its content"));
}

TEST(ParticleFile, FormatOverridesTheName) {
  EXPECT_TRUE(read_particles("run.dump", three_frames, {.format = "xyz"}).ok());
  EXPECT_THAT(particle_error("run.xyz", three_frames, {.format = "abc"}),
              HasSubstr("there is no format 'abc' of particle files, expected one of "));
}

TEST(ParticleFile, RenamingNamedColumnsIsRefused) {
  for (const char* name : {"a.gro", "a.pdb", "a.pqr", "a.cif", "a.ply"}) {
    EXPECT_THAT(particle_error(name, "", {.columns = {"x", "y", "z"}}),
                HasSubstr("names its columns itself (columns)"));
  }
}

TEST(ParticleFile, CountsFramesFromBothEnds) {
  const auto x = [](long frame) {
    const auto read = read_particles("run.xyz", three_frames, {}, frame);
    return read ? read.value().positions.at(0).x : -1;
  };
  EXPECT_EQ(x(0), 1);
  EXPECT_EQ(x(2), 3);
  EXPECT_EQ(x(-1), 3);
  EXPECT_EQ(x(-3), 1);
  for (const long frame : {3L, -4L, 1000L}) {
    EXPECT_EQ(particle_error("run.xyz", three_frames, {}, frame),
              "0:0: there is no frame " + std::to_string(frame) + ", it has 3 frames (frame)");
  }
}

TEST(ParticleFile, PackedFilesAreUnpackedOrToldDamaged) {
  // "hello\n", packed by gzip -n and by zstd.
  const std::string gzip(
      "\x1f\x8b\x08\x00\x00\x00\x00\x00\x00\x03\xcb\x48\xcd\xc9\xc9\xe7\x02\x00\x20\x30\x3a\x36"
      "\x06\x00\x00\x00",
      26);
  const std::string zstd(
      "\x28\xb5\x2f\xfd\x24\x06\x31\x00\x00\x68\x65\x6c\x6c\x6f\x0a\x53\x88\xbd\x91", 19);
  for (const std::string& packed : {gzip, zstd}) {
    for (const char* name : {"a.xyz.gz", "a.xyz", "a.xyz.zst"}) {
      EXPECT_THAT(particle_error(name, packed),
                  HasSubstr("1:1: expected a count of particles, found 'hello' (count)"));
    }
    for (const char* ending : {"xyz", "dump", "data", "ply", "csv"}) {
      EXPECT_THAT(particle_error(std::string("a.") + ending, packed.substr(0, packed.size() - 3)),
                  HasSubstr("are damaged: the file ends before"));
    }
  }
}

TEST(ParticleFile, ErrorsSayWhatHelpsWithOtherFormats) {
  const auto error = [](const char* name) { return particle_error(name, "\x01\x02"); };
  EXPECT_THAT(error("conf"), HasSubstr("boule.from_ase of Python shows what ASE reads"));
  EXPECT_THAT(error("conf"), HasSubstr("--input-format library has ASE look at it"));
  EXPECT_THAT(error("run.tng"), HasSubstr("MDAnalysis or OVITO makes a .pdb, .gro or .dump of it"));
  EXPECT_THAT(error("scan.LAS"), HasSubstr("CloudCompare makes a .ply of it"));
  EXPECT_THAT(error("sky.fits"), HasSubstr("boule.from_particles"));
}

TEST(ParticleFile, OtherPackersAreNamed) {
  EXPECT_THAT(particle_error("a.xyz.lzma", std::string("\x5d\0\0\x80", 4)),
              HasSubstr("it is packed by LZMA, which is not read; unpack it first (unlzma)"));
  EXPECT_THAT(particle_error("a.xyz", std::string("\x04\x22\x4d\x18", 4)),
              HasSubstr("it is packed by LZ4, which is not read; unpack it first (unlz4)"));
}

TEST(ParticleFile, ErrorsNameTheFile) {
  for (const char* bytes : {"x\n", "1\n\nA 0 0 x\n"}) {
    const auto read = read_particles("run.xyz", bytes);
    ASSERT_FALSE(read.ok());
    EXPECT_THAT(read.error().file, HasSubstr("/run.xyz"));
  }
  EXPECT_FALSE(ParticleFile::open("/nowhere/run.xyz").ok());
}

}  // namespace
}  // namespace boule
