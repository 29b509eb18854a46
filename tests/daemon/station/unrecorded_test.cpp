#include "daemon/station/unrecorded.h"

#include <gtest/gtest.h>

namespace mdof::daemon {
namespace {

SampleBlock block(const std::string& device, std::int64_t first_ns, std::size_t scans) {
  SampleBlock block;
  block.device = device;
  block.channels = {{"A", Unit::um}, {"B", Unit::um}};
  block.value.resize(2);
  block.quality.resize(2);
  for (std::size_t i = 0; i < scans; ++i) {
    block.time_ns.push_back(first_ns + static_cast<std::int64_t>(i));
    for (std::size_t c = 0; c < 2; ++c) {
      block.value[c].push_back(static_cast<double>(block.time_ns.back()) + 0.5 * c);
      block.quality[c].push_back(Quality::simulated);
    }
  }
  return block;
}

TEST(Unrecorded, TheBlocksOfADeviceAreJoined) {
  Unrecorded unrecorded;
  unrecorded.add(block("capa", 0, 200));
  unrecorded.add(block("t7", 5, 3));
  unrecorded.add(block("capa", 200, 300));
  const auto taken = unrecorded.take();
  ASSERT_EQ(taken.size(), 2u);
  const SampleBlock whole = block("capa", 0, 500);
  EXPECT_EQ(taken[0].device, "capa");
  EXPECT_EQ(taken[0].channels, whole.channels);
  EXPECT_EQ(taken[0].time_ns, whole.time_ns);
  EXPECT_EQ(taken[0].value, whole.value);
  EXPECT_EQ(taken[0].quality, whole.quality);
  EXPECT_EQ(taken[1].device, "t7");
  EXPECT_EQ(taken[1].time_ns, block("t7", 5, 3).time_ns);
  EXPECT_TRUE(unrecorded.empty());
  EXPECT_TRUE(unrecorded.take().empty());
}

// The number of lost scans belongs to the block after the loss.
TEST(Unrecorded, ANewBlockBeginsAfterALoss) {
  Unrecorded unrecorded;
  unrecorded.add(block("capa", 0, 2));
  SampleBlock after = block("capa", 10, 2);
  after.lost = 8;
  unrecorded.add(after);
  unrecorded.add(block("capa", 12, 2));
  const auto taken = unrecorded.take();
  ASSERT_EQ(taken.size(), 2u);
  EXPECT_EQ(taken[0].lost, 0u);
  EXPECT_EQ(taken[0].scans(), 2u);
  EXPECT_EQ(taken[1].lost, 8u);
  EXPECT_EQ(taken[1].time_ns, block("capa", 10, 4).time_ns);
}

TEST(Unrecorded, ANewBlockBeginsWithOtherChannels) {
  Unrecorded unrecorded;
  unrecorded.add(block("capa", 0, 2));
  SampleBlock other = block("capa", 2, 2);
  other.channels[1].id = "C";
  unrecorded.add(other);
  const auto taken = unrecorded.take();
  ASSERT_EQ(taken.size(), 2u);
  EXPECT_EQ(taken[1].channels, other.channels);
}

// If a device reports no qualities, its samples are good.
TEST(Unrecorded, MissingQualityMeansGood) {
  Unrecorded unrecorded;
  SampleBlock silent = block("capa", 0, 2);
  silent.quality.clear();
  unrecorded.add(silent);
  unrecorded.add(block("capa", 2, 1));
  const auto taken = unrecorded.take();
  ASSERT_EQ(taken.size(), 1u);
  EXPECT_EQ(taken[0].quality_at(1, 1), Quality::good);
  EXPECT_EQ(taken[0].quality_at(1, 2), Quality::simulated);
}

}  // namespace
}  // namespace mdof::daemon
