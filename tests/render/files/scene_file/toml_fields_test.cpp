// Every field that a struct of the scene lists can be given in a TOML file: the reader knows its
// key, in each kind of table.
#include <string>
#include <type_traits>
#include <variant>

#include "tests/render/files/scene_file/scene_folder.h"

namespace boule {
namespace {

/// The message about an unknown key in a table: it lists the keys that are known there.
std::string known_keys(const std::string& table) {
  const test::SceneFolder files;
  const auto loaded = files.load("scene.toml", "schema = 1\n" + table + "\nqqqqqqqqqqqqqqq = 1\n");
  EXPECT_FALSE(loaded.ok()) << table;
  return loaded.ok() ? "" : loaded.error().message;
}

/// Of a size that is as the file has it there is no key.
template <class Member>
constexpr bool has_key(const FileRule&, const Both<Member>&) {
  return false;
}
template <class Rule, class Member>
constexpr bool has_key(const Rule&, const Member&) {
  return true;
}

template <class T>
int expect_known(const T& value, const std::string& table) {
  const std::string known = known_keys(table);
  int keys = 0;
  each_field(value, [&](const auto& field, const auto& member) {
    if constexpr (HasFields<std::remove_cvref_t<decltype(member)>>) {
      keys += expect_known(member, table);
    } else if (has_key(field.rule, member)) {
      ++keys;
      EXPECT_THAT(known, testing::HasSubstr("'" + std::string(field.key) + "'")) << table;
    }
  });
  return keys;
}

template <class... Kinds>
int expect_all_known(const std::variant<Kinds...>&, const std::string& header) {
  const auto table = [&](std::string_view type) {
    return header + "\ntype = \"" + std::string(type) + "\"";
  };
  return (0 + ... + expect_known(Kinds{}, table(fields<Kinds>.type)));
}

TEST(TomlFields, EveryListedKeyIsKnown) {
  EXPECT_GT(expect_all_known(Camera{}, "[camera]"), 0);
  EXPECT_GT(expect_all_known(Light{}, "[[light]]"), 0);
  EXPECT_GT(expect_all_known(Material{}, "[material.m]"), 0);
  EXPECT_GT(expect_all_known(Background{}, "[background]"), 0);
  EXPECT_GT(expect_known(Sphere{}, "[[sphere]]"), 0);
  EXPECT_GT(expect_known(Plane{}, "[[plane]]"), 0);
  EXPECT_GT(expect_known(Instance{}, "[group.g]\n[[instance]]"), 0);
  EXPECT_GT(expect_known(ImageSettings{}, "[image]"), 0);
  EXPECT_GT(expect_known(RenderSettings{}, "[render]"), 0);
  const std::string camera = "[camera]\neye = [0, 0, 1]\nlook_at = [0, 0, 0]\n";
  EXPECT_GT(expect_known(DistortionMap{}, camera + "[camera.distortion]"), 0);
}

}  // namespace
}  // namespace boule
