// What waits for clients: it is bounded, and the newest wins.
#include "render/apps/view/session/outbox.h"

#include <gtest/gtest.h>

#include "render/apps/view/session/audience.h"

namespace boule::view {
namespace {

FrameHeader header(int pane) {
  FrameHeader header;
  header.pane = pane;
  header.width = 3;
  header.height = 2;
  return header;
}

Frame frame_of(const std::optional<Outbox::Message>& message) {
  Frame frame;
  EXPECT_TRUE(message && message->binary && decode(message->bytes, frame));
  return frame;
}

TEST(FrameHeader, IsReadBack) {
  FrameHeader before = header(2);
  before.code = PictureCode::png;
  before.finished = true;
  before.scale = 12;
  before.number = 0xfedcba98;
  before.frame = 0x01020304;
  before.width = 4096;
  before.height = 65535;
  before.passes = 77;
  before.spp = 1.25F;
  before.share = 0.5F;
  const auto bytes = encode(before);
  Frame frame;
  ASSERT_TRUE(decode(std::string(bytes.data(), bytes.size()) + "picture", frame));
  EXPECT_EQ(encode(frame.header), bytes);
  EXPECT_EQ(frame.picture, "picture");
  EXPECT_EQ(bytes[0], 'B');
  EXPECT_EQ(bytes[12], 4);  // the lowest byte first
  EXPECT_FALSE(decode("BVF", frame));
  EXPECT_FALSE(decode(std::string(40, 'x'), frame));
}

TEST(Outbox, OneFrameInFlightThenTheNewest) {
  int notified = 0;
  Outbox outbox([&] { ++notified; });
  for (int i = 0; i < 100; ++i) outbox.add_frame(header(0), "frame " + std::to_string(i));
  EXPECT_EQ(notified, 100);
  const Frame first = frame_of(outbox.take());
  EXPECT_EQ(first.picture, "frame 99");
  outbox.add_frame(header(0), "later");
  EXPECT_FALSE(outbox.take());
  outbox.acknowledge(first.header.frame + 1);  // of a frame that was never sent
  EXPECT_FALSE(outbox.take());
  outbox.acknowledge(first.header.frame);
  EXPECT_EQ(frame_of(outbox.take()).picture, "later");
}

TEST(Outbox, PanesTakeTurns) {
  Outbox outbox([] {});
  std::string turns;
  for (int i = 0; i < 6; ++i) {
    for (int pane = 0; pane < 3; ++pane) outbox.add_frame(header(pane), std::to_string(pane));
    const Frame frame = frame_of(outbox.take());
    turns += frame.picture;
    outbox.acknowledge(frame.header.frame);
  }
  EXPECT_EQ(turns, "120120");
}

TEST(Outbox, TextsComeFirstAndAllOfThem) {
  Outbox outbox([] {});
  outbox.add_frame(header(0), "frame");
  outbox.report("statistics", "old");
  outbox.report("statistics", "new");
  outbox.add_text("a");
  outbox.add_text("b");
  EXPECT_EQ(outbox.take()->bytes, "a");
  EXPECT_EQ(outbox.take()->bytes, "b");
  EXPECT_EQ(outbox.take()->bytes, "new");
  EXPECT_TRUE(outbox.take()->binary);
  EXPECT_FALSE(outbox.take());
}

TEST(Outbox, SilentClientIsGivenUp) {
  Outbox outbox([] {});
  const std::string text(1 << 16, 'x');
  for (int i = 0; i < 1000; ++i) outbox.add_text(text);
  EXPECT_TRUE(outbox.overflowed());
  std::size_t waiting = 0;
  while (const auto message = outbox.take()) waiting += message->bytes.size();
  EXPECT_LE(waiting, std::size_t{5} << 20);
}

TEST(Audience, ClientsHaveAllAtTheirPace) {
  int notified = 0;
  Audience audience([&] { ++notified; });
  audience.add_text("for nobody");
  const int slow = audience.join(), quick = audience.join();
  ASSERT_NE(slow, quick);
  EXPECT_EQ(audience.size(), 2U);
  const auto outbox = audience.outbox(quick);
  for (int i = 0; i < 3; ++i) {
    audience.add_frame(header(0), std::to_string(i));
    EXPECT_TRUE(audience.holds_frame(0));
    const Frame frame = frame_of(outbox->take());
    EXPECT_EQ(frame.picture, std::to_string(i));
    EXPECT_FALSE(audience.holds_frame(0));
    outbox->acknowledge(frame.header.frame);
  }
  EXPECT_EQ(frame_of(audience.outbox(slow)->take()).picture, "2");
  EXPECT_GT(notified, 0);
}

TEST(Audience, AnswersGoToWhoAsked) {
  Audience audience([] {});
  const int one = audience.join(), other = audience.join();
  audience.answer(one, "answer");
  audience.report_to(one, "saving", "half");
  audience.report_to_others(one, "camera", "moved");
  EXPECT_EQ(audience.outbox(one)->take()->bytes, "answer");
  EXPECT_EQ(audience.outbox(one)->take()->bytes, "half");
  EXPECT_FALSE(audience.outbox(one)->take());
  EXPECT_EQ(audience.outbox(other)->take()->bytes, "moved");
  audience.leave(one);
  audience.answer(one, "too late");
  EXPECT_EQ(audience.outbox(one), nullptr);
  EXPECT_FALSE(audience.outbox(other)->take());
}

}  // namespace
}  // namespace boule::view
