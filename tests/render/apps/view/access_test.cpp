// Who may talk to the server of boule view.
#include "render/apps/view/server/access.h"

#include <gtest/gtest.h>

#include <set>

namespace boule::view {
namespace {

TEST(Access, TokensAreLongAndNeverTheSame) {
  std::set<std::string> all;
  for (int i = 0; i < 100; ++i) {
    const auto token = random_token();
    ASSERT_TRUE(token);
    EXPECT_EQ(token.value().size(), 32u);
    EXPECT_EQ(token.value().find_first_not_of("0123456789abcdef"), std::string::npos);
    all.insert(token.value());
  }
  EXPECT_EQ(all.size(), 100u);
}

TEST(Access, SecretComparesEveryByte) {
  EXPECT_TRUE(same_secret("0123456789", "0123456789"));
  for (std::size_t i = 0; i < 10; ++i) {
    std::string other = "0123456789";
    other[i] = 'x';
    EXPECT_FALSE(same_secret("0123456789", other)) << i;
  }
  EXPECT_FALSE(same_secret("0123456789", "012345678"));
  EXPECT_FALSE(same_secret("0123456789", ""));
  EXPECT_FALSE(same_secret("a", std::string("a\0", 2)));
}

TEST(Access, AHostIsANumberOrLocalhost) {
  for (const char* host : {"127.0.0.1", "127.0.0.1:8080", "localhost:1", "LocalHost", "[::1]:80",
                           "[::1]", "192.168.0.7:65535"}) {
    EXPECT_TRUE(is_own_host(host)) << host;
  }
  for (const char* host :
       {"", "evil.example", "evil.example:8080", "127.0.0.1.evil.example", "localhost.evil:80",
        "127.0.0.1:", "127.0.0.1:80x", "127.0.0.1:123456", "127.0.0", "127.0.0.256", "127.0.0.1.1",
        "0x7f.0.0.1", "2130706433", "[evil]", "[::1].evil", "::1", "localhost@evil", "1.2.3.4 "}) {
    EXPECT_FALSE(is_own_host(host)) << host;
  }
}

TEST(Access, AnOriginIsTheServerItself) {
  EXPECT_TRUE(is_own_origin("http://127.0.0.1:8080", "127.0.0.1:8080"));
  for (const char* origin :
       {"", "null", "http://evil.example", "http://127.0.0.1:8081", "https://127.0.0.1:8080",
        "http://127.0.0.1:8080.evil.example", "http://127.0.0.1:8080/", "http://localhost:8080"}) {
    EXPECT_FALSE(is_own_origin(origin, "127.0.0.1:8080")) << origin;
  }
}

TEST(Access, TargetsAreCutAtTheQuery) {
  EXPECT_EQ(read_target("/view.js").path, "/view.js");
  EXPECT_EQ(read_target("/?token=abc").path, "/");
  EXPECT_EQ(read_target("/?token=abc").token, "abc");
  EXPECT_EQ(read_target("/?a=b&token=abc&c").token, "abc");
  EXPECT_EQ(read_target("/?a=token=abc").token, "");
  EXPECT_EQ(read_target("/?&&&").token, "");
  EXPECT_EQ(read_target("").path, "");
  EXPECT_EQ(read_target("?").token, "");
  EXPECT_EQ(read_target("/%2e%2e/?token=%61").token, "%61");  // nothing is decoded
}

TEST(Access, PicturesHaveNumbers) {
  EXPECT_EQ(picture_number("/picture/12"), 12);
  for (const char* path : {"/picture/", "/picture/-1", "/picture/+1", "/picture/1/", "/picture/1x",
                           "/picture/99999999999", "/picture", "/pictures/1", "/picture/../1"}) {
    EXPECT_FALSE(picture_number(path)) << path;
  }
}

}  // namespace
}  // namespace boule::view
