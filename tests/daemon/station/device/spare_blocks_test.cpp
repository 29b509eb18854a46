#include "daemon/station/device/spare_blocks.h"

#include <gtest/gtest.h>

namespace mdof::daemon {
namespace {

SampleBlock used(const std::string& device, std::size_t scans) {
  SampleBlock block;
  block.device = device;
  block.time_ns.assign(scans, 1);
  return block;
}

TEST(SpareBlocks, TheLastBlockOfADeviceIsReusedWithItsMemory) {
  SpareBlocks spare;
  spare.put(used("capa", 100));
  SampleBlock last = used("capa", 200);
  const auto* memory = last.time_ns.data();
  spare.put(std::move(last));
  spare.put(used("t7", 300));
  EXPECT_EQ(spare.take("capa").time_ns.data(), memory);
  EXPECT_EQ(spare.take("capa").scans(), 100u);
  EXPECT_EQ(spare.take("capa").scans(), 0u);
  EXPECT_EQ(spare.take("t7").scans(), 300u);
}

TEST(SpareBlocks, KeepsOnlyAFewBlocks) {
  SpareBlocks spare;
  for (std::size_t i = 1; i <= 100; ++i) spare.put(used("capa", i));
  std::size_t kept = 0;
  while (spare.take("capa").scans() > 0) ++kept;
  EXPECT_EQ(kept, 16u);
}

}  // namespace
}  // namespace mdof::daemon
