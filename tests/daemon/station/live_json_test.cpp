// The JSON object of one device in device.list.
#include "daemon/station/live_json.h"

#include <gtest/gtest.h>

namespace mdof::daemon {
namespace {

std::string with_rates(double stated_hz, double measured_hz) {
  DeviceStatus status;
  status.info.rate_hz = stated_hz;
  status.measured_hz = measured_hz;
  return device_json(status);
}

TEST(LiveJson, RateIsTheStatedElseTheMeasuredRateElseNull) {
  EXPECT_NE(with_rates(1000, 990.5).find("\"rate_hz\":1000,"), std::string::npos);
  EXPECT_NE(with_rates(0, 49.75).find("\"rate_hz\":49.75,"), std::string::npos);
  EXPECT_NE(with_rates(0, 0).find("\"rate_hz\":null,"), std::string::npos) << with_rates(0, 0);
}

}  // namespace
}  // namespace mdof::daemon
