// The time stamp of a scan of several inputs that are read one after another.
#include "drivers/sysfs/poller.h"

#include <gtest/gtest.h>

#include <array>
#include <thread>

#include "drivers/clock/monotonic.h"

namespace mdof::drivers {
namespace {

using std::chrono::milliseconds;

// The rule of drivers/README.md: a delay is the time from the reading of an input to the reading of
// the last input of the scan. A converter that needs 110 ms for each channel makes this visible.
TEST(SysfsPoller, StampsAScanWithTheTimeOfItsLastReading) {
  struct Reading {
    std::int64_t begin_ns = 0, end_ns = 0;
  };
  std::array<Reading, 2> readings;
  SysfsPoller poller("converter", "linux_iio", 10, 0, [&]() -> Result<SysfsDevice> {
    SysfsDevice device;
    device.description = "a slow converter";
    for (std::size_t i = 0; i < readings.size(); ++i)
      device.inputs.push_back({{std::string(1, static_cast<char>('A' + i)), Unit::um},
                               [&readings, i]() -> Result<SysfsReading> {
                                 readings[i].begin_ns = monotonic_ns();
                                 std::this_thread::sleep_for(milliseconds(20));
                                 readings[i].end_ns = monotonic_ns();
                                 return SysfsReading{1.0};
                               }});
    return device;
  });
  ASSERT_TRUE(poller.open());
  SampleBlock block;
  ASSERT_TRUE(poller.read(block, milliseconds(0)));
  ASSERT_EQ(block.scans(), 1u);
  EXPECT_GE(block.time_ns[0], readings[1].begin_ns);
  EXPECT_LE(block.time_ns[0], readings[1].end_ns);
}

}  // namespace
}  // namespace mdof::drivers
