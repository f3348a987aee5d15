#include "render/image/module/module_search.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/render/image/files.h"
#include "tests/support/temp_dir.h"

namespace boule {
namespace {

namespace fs = std::filesystem;

/// The folders do not depend on where this was built, or on what is there now.
TEST(ModuleSearch, InstalledProgramsSearchAroundThemselvesOnly) {
  const std::vector<fs::path> folders = module_folders("/opt/boule/bin");
  ASSERT_EQ(folders.size(), 2U);
  EXPECT_EQ(folders[0], "/opt/boule/bin");
  EXPECT_THAT(folders[1].string(), testing::StartsWith("/opt/boule/lib"));
  EXPECT_EQ(folders[1].filename(), "boule");
}

TEST(ModuleSearch, InstalledLibrariesSearchTheirOwnFolders) {
  const fs::path library = module_folders("/opt/boule/bin").at(1).parent_path();
  EXPECT_EQ(module_folders(library), (std::vector<fs::path>{library, library / "boule"}));
}

TEST(ModuleSearch, BareCopiesSearchBesideThemselvesOnly) {
  EXPECT_EQ(module_folders("/tmp/mine"), std::vector<fs::path>{"/tmp/mine"});
}

TEST(ModuleSearch, BuiltProgramsSearchTheBuildTreeOnly) {
  const fs::path tree = fs::canonical(BOULE_BUILD_TREE);
  for (const fs::path& own : {tree, tree / "bin", tree / "tests" / "image"}) {
    const std::vector<fs::path> folders = module_folders(own);
    EXPECT_THAT(folders, testing::Contains(fs::canonical(BOULE_IMAGE_MODULE_FOLDER)));
    EXPECT_EQ(folders[0], own);
    for (const fs::path& folder : folders) {
      EXPECT_THAT(folder.string(), testing::StartsWith(tree.string()));
    }
  }
  EXPECT_EQ(module_folders(tree.string() + "-of-others/bin").size(), 2U);
  EXPECT_TRUE(module_folders({}).empty());
}

}  // namespace
}  // namespace boule
