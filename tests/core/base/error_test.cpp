#include "core/base/error.h"

#include <memory>
#include <optional>
#include <stdexcept>
#include <string>
#include <utility>

#include <gtest/gtest.h>

namespace boule {
namespace {

struct FormatCase {
  Diagnostic diagnostic;
  const char* text;
};

TEST(FormatDiagnostic, OmitsUnknownFields) {
  const FormatCase cases[] = {
      {Diagnostic::of("is wrong"), "error: is wrong"},
      {Diagnostic::about("camera.fov", "is wrong"), "error: is wrong (key 'camera.fov')"},
      {Diagnostic::in_file("a.toml", "is wrong"), "a.toml: error: is wrong"},
      {{.message = "is wrong", .file = "a.toml", .line = 3, .column = 14},
       "a.toml:3:14: error: is wrong"},
      {{.message = "is wrong", .file = "a.cif", .line = 3}, "a.cif:3: error: is wrong"},
      {{.message = "is wrong", .key = "camera.fov", .file = "a.toml", .line = 3, .column = 14},
       "a.toml:3:14: error: is wrong (key 'camera.fov')"}};
  for (const FormatCase& c : cases) EXPECT_EQ(format_diagnostic(c.diagnostic), c.text);
}

TEST(FormatDiagnostic, IsOnePrintableLine) {
  const Diagnostic hostile{.message = "saw 'f\x03\n\x1b[31m'",
                           .key = "k\x7f",
                           .file = "a\nb.toml",
                           .line = 3,
                           .column = 9};
  EXPECT_EQ(format_diagnostic(hostile),
            "a\\x0ab.toml:3:9: error: saw 'f\\x03\\x0a\\x1b[31m' (key 'k\\x7f')");
}

/// What value() throws.
template <class AnyResult>
std::string thrown_by(AnyResult&& result) {
  try {
    static_cast<void>(std::forward<AnyResult>(result).value());
  } catch (const std::runtime_error& error) {
    return error.what();
  }
  return "nothing";
}

TEST(Result, ValueOfAnErrorThrowsItsText) {
  Result<int> wrong = Diagnostic::about("camera.fov", "is wrong");
  const Result<int> also_wrong = wrong;
  const std::string text = "error: is wrong (key 'camera.fov')";
  EXPECT_EQ(thrown_by(wrong), text);
  EXPECT_EQ(thrown_by(also_wrong), text);
  EXPECT_EQ(thrown_by(Result<int>(wrong)), text);
  EXPECT_EQ(thrown_by(Result<int>(3)), "nothing");
}

TEST(ResultDeathTest, UncheckedProgramsEndWithTheText) {
  const auto end = [] { static_cast<void>(Result<int>(Diagnostic::of("no such scene")).value()); };
  EXPECT_DEATH([&]() noexcept { end(); }(), "error: no such scene");
}

struct QuoteCase {
  std::string text;
  std::string quoted;
};

TEST(Quote, EscapesControlBytesAndCuts) {
  const std::string forty(40, 'x');
  const QuoteCase cases[] = {{"", "''"},
                             {"plain text", "'plain text'"},
                             {"a\nb", "'a\\x0ab'"},
                             {"\x1b[31m", "'\\x1b[31m'"},
                             {"\x7f", "'\\x7f'"},
                             {std::string("a\0b", 3), "'a\\x00b'"},
                             {"caf\xc3\xa9", "'caf\xc3\xa9'"},  // text beyond ASCII stays readable
                             {forty, "'" + forty + "'"},
                             {forty + "y", "'" + forty + "...'"},
                             {std::string(41, '\n'), "'" + [] {
                                std::string escaped;
                                for (int i = 0; i < 40; ++i) escaped += "\\x0a";
                                return escaped;
                              }() + "...'"}};
  for (const QuoteCase& c : cases) EXPECT_EQ(quote(c.text), c.quoted);
}

TEST(Quote, TakesAnotherLimit) {
  EXPECT_EQ(quote("abcdef", 3), "'abc...'");
  EXPECT_EQ(quote("abc", 3), "'abc'");
}

TEST(Result, HoldsAValueOrADiagnostic) {
  const Result<int> good = 7;
  ASSERT_TRUE(good.ok());
  EXPECT_TRUE(static_cast<bool>(good));
  EXPECT_EQ(good.value(), 7);

  const Result<int> bad = Diagnostic::about("size", "no number");
  EXPECT_FALSE(bad.ok());
  EXPECT_FALSE(static_cast<bool>(bad));
  EXPECT_EQ(bad.error().message, "no number");
  EXPECT_EQ(bad.error().key, "size");
}

TEST(Status, ReadsLikeAResult) {
  const Status good;
  EXPECT_TRUE(good);
  EXPECT_TRUE(good.ok());
  EXPECT_THROW(static_cast<void>(good.error()), std::bad_optional_access);
  const Status bad = Diagnostic::about("spp", "too many");
  EXPECT_FALSE(bad);
  EXPECT_FALSE(bad.ok());
  EXPECT_EQ(bad.error().key, "spp");
}

TEST(Result, MovesOutMoveOnlyValues) {
  Result<std::unique_ptr<int>> result = std::make_unique<int>(3);
  *result.value() = 4;
  const std::unique_ptr<int> taken = std::move(result).value();
  EXPECT_EQ(*taken, 4);
}

}  // namespace
}  // namespace boule
