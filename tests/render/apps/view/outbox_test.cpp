// What waits for a client: it is bounded, and the newest wins.
#include "render/apps/view/session/outbox.h"

#include <gtest/gtest.h>

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
  outbox.reset(true);
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
  outbox.reset(true);
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
  outbox.reset(true);
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
  outbox.reset(true);
  const std::string text(1 << 16, 'x');
  for (int i = 0; i < 1000; ++i) outbox.add_text(text);
  EXPECT_TRUE(outbox.overflowed());
  std::size_t waiting = 0;
  while (const auto message = outbox.take()) waiting += message->bytes.size();
  EXPECT_LE(waiting, std::size_t{5} << 20);
}

TEST(Outbox, KeepsNothingForNobody) {
  Outbox outbox([] {});
  outbox.add_text("a");
  outbox.add_frame(header(0), "frame");
  outbox.report("statistics", "s");
  EXPECT_FALSE(outbox.take());
  outbox.reset(true);
  outbox.add_text("a");
  outbox.reset(true);  // another client
  EXPECT_FALSE(outbox.take());
}

}  // namespace
}  // namespace boule::view
