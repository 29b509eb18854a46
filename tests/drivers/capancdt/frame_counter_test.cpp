#include "drivers/capancdt/frame_counter.h"

#include <gtest/gtest.h>

#include "drivers/capancdt/rate_watch.h"

namespace mdof::drivers::capancdt {
namespace {

constexpr std::uint64_t kMostLost = 1000;

// Simulates the packets of a controller. `unit`: the unit in which the controller's counter
// counts.
struct Source {
  CounterUnit unit;
  int channels, frames, averaged;
  std::uint32_t counter = 0;

  Packet next() {
    Packet packet;
    for (int i = 1; i <= channels; ++i) packet.channel_bits |= channel_bit(i);
    packet.values.resize(static_cast<std::size_t>(channels) * static_cast<std::size_t>(frames));
    packet.counter = counter;
    const int step[] = {frames, frames * channels, frames * averaged, 1};
    counter += static_cast<std::uint32_t>(step[static_cast<int>(unit)]);
    return packet;
  }
};

struct Case {
  CounterUnit unit;
  int channels, frames, averaged;
};
constexpr Case kCases[] = {
    {CounterUnit::frame, 4, 1, 1},  {CounterUnit::frame, 1, 1, 1},  {CounterUnit::frame, 4, 3, 1},
    {CounterUnit::frame, 2, 5, 4},  {CounterUnit::value, 4, 1, 1},  {CounterUnit::value, 3, 7, 1},
    {CounterUnit::value, 3, 2, 8},  {CounterUnit::sample, 4, 1, 8}, {CounterUnit::sample, 2, 3, 5},
    {CounterUnit::packet, 4, 3, 1}, {CounterUnit::packet, 2, 5, 4}, {CounterUnit::packet, 1, 2, 2},
};

TEST(CapancdtFrameCounter, LearnsTheUnitAndCountsLosses) {
  for (const Case& c : kCases) {
    // The counter wraps after some packets.
    Source source{c.unit, c.channels, c.frames, c.averaged, 4294967290u};
    FrameCounter counter(c.averaged, kMostLost);
    std::deque<PlacedPacket> placed;
    for (int i = 0; i < 20; ++i) ASSERT_TRUE(counter.add(source.next(), placed));
    ASSERT_EQ(placed.size(), 20u);
    for (int i = 0; i < 5; ++i) source.next();
    ASSERT_TRUE(counter.add(source.next(), placed));
    const PlacedPacket& last = placed.back();
    EXPECT_EQ(last.lost, static_cast<std::uint64_t>(5 * c.frames));
    EXPECT_EQ(last.first_frame, 25 * c.frames);
    EXPECT_EQ(counter.lost(), last.lost);
    for (int i = 0; i < 20; ++i) {
      EXPECT_EQ(placed[static_cast<std::size_t>(i)].first_frame, i * c.frames);
      EXPECT_EQ(placed[static_cast<std::size_t>(i)].lost, 0u);
    }
  }
}

TEST(CapancdtFrameCounter, HoldsPacketsBackUntilTheUnitIsKnown) {
  Source source{CounterUnit::value, 4, 1, 1};
  FrameCounter counter(1, kMostLost);
  std::deque<PlacedPacket> placed;
  for (int i = 0; i < 3; ++i) ASSERT_TRUE(counter.add(source.next(), placed));
  EXPECT_TRUE(placed.empty());
  EXPECT_EQ(counter.unit(), std::nullopt);
  ASSERT_TRUE(counter.add(source.next(), placed));
  EXPECT_EQ(placed.size(), 4u);
  EXPECT_EQ(counter.unit(), CounterUnit::value);
}

TEST(CapancdtFrameCounter, LearnsTheUnitDespiteLosses) {
  Source source{CounterUnit::frame, 4, 1, 1};
  FrameCounter counter(1, kMostLost);
  std::deque<PlacedPacket> placed;
  for (int i = 0; i < 12; ++i) {
    // With this loss of frames, the counter increases as if it counted values.
    if (i % 4 == 1) source.counter += 3;
    ASSERT_TRUE(counter.add(source.next(), placed));
  }
  EXPECT_EQ(counter.unit(), CounterUnit::frame);
  EXPECT_EQ(counter.lost(), 9u);
  EXPECT_EQ(placed.back().first_frame, 11 + 9);
}

TEST(CapancdtFrameCounter, DropsDuplicates) {
  Source source{CounterUnit::frame, 2, 2, 1, 1000};
  FrameCounter counter(1, kMostLost);
  std::deque<PlacedPacket> placed;
  const Packet first = source.next();
  ASSERT_TRUE(counter.add(first, placed));
  ASSERT_TRUE(counter.add(first, placed));  // a duplicate before the unit of the counter is known
  for (int i = 0; i < 5; ++i) {
    const Packet packet = source.next();
    ASSERT_TRUE(counter.add(packet, placed));
    ASSERT_TRUE(counter.add(packet, placed));
  }
  ASSERT_TRUE(counter.add(first, placed));  // a much older packet
  EXPECT_EQ(counter.duplicates(), 7u);
  EXPECT_EQ(counter.lost(), 0u);
  EXPECT_EQ(placed.size(), 6u);
}

// Each packet is sent twice. FrameCounter must not interpret the repeated counts as a jump back.
TEST(CapancdtFrameCounter, RepetitionOfEveryPacketIsNotAJump) {
  Source source{CounterUnit::frame, 2, 2, 1, 1000};
  FrameCounter counter(1, kMostLost);
  std::deque<PlacedPacket> placed;
  for (int i = 0; i < 200; ++i) {
    const Packet packet = source.next();
    ASSERT_TRUE(counter.add(packet, placed)) << i;
    ASSERT_TRUE(counter.add(packet, placed)) << i;
  }
  EXPECT_EQ(counter.duplicates(), 200u);
}

// A packet has 21 values. A packet is repeated after two further packets, so its counter is 42
// below the newest counter.
TEST(CapancdtFrameCounter, DropsDuplicatesOfLargePackets) {
  Source source{CounterUnit::value, 3, 7, 1, 1000};
  FrameCounter counter(1, kMostLost);
  std::deque<PlacedPacket> placed;
  std::vector<Packet> sent;
  for (int i = 0; i < 10; ++i) {
    sent.push_back(source.next());
    ASSERT_TRUE(counter.add(sent.back(), placed));
  }
  ASSERT_TRUE(counter.add(sent[7], placed));
  ASSERT_TRUE(counter.add(source.next(), placed));
  EXPECT_EQ(counter.duplicates(), 1u);
  EXPECT_EQ(counter.lost(), 0u);
  EXPECT_EQ(placed.back().first_frame, 70);
}

TEST(CapancdtFrameCounter, LearnsAgainWhenPacketsGrow) {
  // If a packet has one frame, a counter of frames and a counter of packets are equal.
  Source source{CounterUnit::packet, 2, 1, 1};
  FrameCounter counter(1, kMostLost);
  std::deque<PlacedPacket> placed;
  for (int i = 0; i < 10; ++i) ASSERT_TRUE(counter.add(source.next(), placed));
  EXPECT_EQ(counter.unit(), CounterUnit::frame);
  source.frames = 3;
  for (int i = 0; i < 10; ++i) ASSERT_TRUE(counter.add(source.next(), placed));
  EXPECT_EQ(counter.unit(), CounterUnit::packet);
  ASSERT_EQ(placed.size(), 20u);
  EXPECT_EQ(placed.back().first_frame, 10 + 9 * 3);
  EXPECT_EQ(counter.lost(), 0u);
}

TEST(CapancdtFrameCounter, LearnsAgainWhenAChannelIsAdded) {
  Source source{CounterUnit::value, 1, 1, 1};
  FrameCounter counter(1, kMostLost);
  std::deque<PlacedPacket> placed;
  for (int i = 0; i < 10; ++i) ASSERT_TRUE(counter.add(source.next(), placed));
  source.channels = 3;
  for (int i = 0; i < 10; ++i) ASSERT_TRUE(counter.add(source.next(), placed));
  EXPECT_EQ(counter.unit(), CounterUnit::value);
  EXPECT_EQ(counter.lost(), 0u);
  EXPECT_EQ(placed.back().first_frame, 19);
}

TEST(CapancdtFrameCounter, JumpIsAnError) {
  for (const std::uint32_t to : {0u, 500'000u, 1'002'000u, 4'000'000'000u}) {
    Source source{CounterUnit::frame, 2, 1, 1, 1'000'000};
    FrameCounter counter(1, kMostLost);
    std::deque<PlacedPacket> placed;
    for (int i = 0; i < 10; ++i) ASSERT_TRUE(counter.add(source.next(), placed));
    source.counter = to;
    const Status jumped = counter.add(source.next(), placed);
    ASSERT_FALSE(jumped) << to;
    EXPECT_NE(jumped.error().message.find("jumped from 1000009 to " + std::to_string(to)),
              std::string::npos);
    EXPECT_EQ(placed.size(), 10u);
  }
}

TEST(CapancdtFrameCounter, ConstantCounterIsAnError) {
  FrameCounter counter(1, kMostLost);
  std::deque<PlacedPacket> placed;
  Source source{CounterUnit::frame, 2, 1, 1};
  const Packet packet = source.next();
  int packets = 0;
  while (packets < 1000 && counter.add(packet, placed)) ++packets;
  EXPECT_LT(packets, 100);
}

TEST(CapancdtFrameCounter, UnknownUnitIsAnError) {
  FrameCounter counter(1, kMostLost);
  std::deque<PlacedPacket> placed;
  Source source{CounterUnit::frame, 2, 1, 1};
  int packets = 0;
  for (; packets < 1000; ++packets) {
    source.counter += 6;
    if (!counter.add(source.next(), placed)) break;
  }
  EXPECT_LT(packets, 100);
  EXPECT_TRUE(placed.empty());
}

TEST(CapancdtRateWatch, ReportsARateThatDiffersFromTheNominalRate) {
  for (const double ratio : {0.5, 0.85, 1.15, 3.0}) {
    RateWatch watch(1e6);
    std::optional<double> measured;
    double t_ns = 0;
    for (int i = 0; i < 20'000 && !measured; ++i, t_ns += ratio * 1e6)
      measured = watch.add(i, static_cast<std::int64_t>(t_ns));
    ASSERT_TRUE(measured) << ratio;
    EXPECT_NEAR(*measured, ratio * 1e6, ratio * 1e3);
  }
}

TEST(CapancdtRateWatch, ToleratesDelays) {
  RateWatch watch(1e6);
  std::int64_t network_delay_ns = 0;
  for (int i = 0; i < 60'000; ++i) {
    // A delay of the network, which decreases afterwards.
    if (i % 7000 == 0) network_delay_ns = 900'000'000;
    network_delay_ns = std::max<std::int64_t>(0, network_delay_ns - 900'000);
    EXPECT_FALSE(watch.add(i, i * std::int64_t{1'000'000} + network_delay_ns)) << i;
  }
}

TEST(CapancdtRateWatch, ToleratesSlowControllers) {
  RateWatch watch(400e6);  // nominal rate: 2.5 frames per second
  for (int i = 0; i < 1000; ++i)
    EXPECT_FALSE(watch.add(i, i * std::int64_t{400'000'000} + (i % 3) * 50'000'000)) << i;
}

// The first frame arrives 64 s after the start of the host's clock. These 64 s do not count as a
// slow interval.
TEST(CapancdtRateWatch, OneSlowIntervalAtTheBeginningIsADelay) {
  RateWatch watch(1e6);
  std::int64_t t_ns = 64'000'000'000;
  for (int i = 0; i < 10'000; ++i) {
    EXPECT_FALSE(watch.add(i, t_ns)) << i;
    t_ns += i < 1'500 ? 1'400'000 : 1'000'000;
  }
}

// The limit of the difference is 10 %. A difference of 9 % is accepted, a difference of 11 % is
// reported.
TEST(CapancdtRateWatch, ReportsDifferencesOverTenPercent) {
  const auto reported = [](double ratio) {
    RateWatch watch(1e6);
    bool tells = false;
    for (int i = 0; i < 10'000; ++i)
      tells = tells || watch.add(i, static_cast<std::int64_t>(i * ratio * 1e6));
    return tells;
  };
  EXPECT_FALSE(reported(1.09));
  EXPECT_FALSE(reported(0.91));
  EXPECT_TRUE(reported(1.11));
  EXPECT_TRUE(reported(0.89));
}

}  // namespace
}  // namespace mdof::drivers::capancdt
