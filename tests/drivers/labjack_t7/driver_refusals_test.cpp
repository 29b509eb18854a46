// The driver rejects a simulated T7 on real sockets, or the T7 rejects its requests. Checks the
// messages.
#include <tuple>

#include "tests/drivers/labjack_t7/driver_fixture.h"

namespace mdof::drivers::labjack_t7::test {
namespace {

TEST_F(LabjackT7Driver, SwappedWordsAreRefused) {
  SimulatedLabjackT7::Faults faults;
  faults.swapped_words = true;
  serve(faults);
  EXPECT_TRUE(has(refusal(), "0x22330011"));
}

TEST_F(LabjackT7Driver, OtherDevicesAreRefused) {
  SimulatedLabjackT7::Options options;
  options.product = 4;
  serve({}, options);
  EXPECT_TRUE(has(refusal(), "PRODUCT_ID is 4"));
  settings.serial = 1;
  made.reset();
  served.reset();
  serve({});
  EXPECT_TRUE(has(refusal(), "serial number of the device is 470012345"));
}

TEST_F(LabjackT7Driver, RefusesTheStampOfAnotherStream) {
  core_reads(1'000'000'000);
  SimulatedLabjackT7::Faults faults;
  faults.stale_stamp = true;
  serve(faults);
  ASSERT_EQ(refusal(), "opened");
  const std::string message = read(20);
  EXPECT_TRUE(has(message, "STREAM_START_TIME_STAMP is 0, which belongs to another stream"))
      << message;
}

// LabJack's ljm_constants.json: firmware 1.0214 added STREAM_START_TIME_STAMP, firmware 1.026
// added STREAM_AUTORECOVER_DISABLE.
TEST_F(LabjackT7Driver, RefusesFirmwareWithoutNeededRegisters) {
  for (const auto& [firmware, says] :
       {std::pair{1.0188F, "1.0188 lacks the time stamp"},
        {1.0213F, "(added in firmware 1.0214)"},
        {1.0214F, "1.0214 lacks the recovery of streams (added in firmware 1.026)"},
        {1.0259F, "(added in firmware 1.026)"},
        {1.026F, "opened"}}) {
    made.reset();
    served.reset();
    SimulatedLabjackT7::Options options;
    options.firmware = firmware;
    serve({}, options);
    const std::string message = refusal();
    EXPECT_TRUE(has(message, says)) << message;
  }
}

TEST_F(LabjackT7Driver, RefusesTheWifiAddressOfAT7Pro) {
  for (const auto& [hardware, wifi_ip, says] :
       {std::tuple{3U, 0x7F000001U, "a T7-Pro cannot stream over WiFi"},
        {3U, 0xC0A80105U, "opened"},     // connected by cable
        {3U, 0U, "opened"},              // WiFi is off
        {1U, 0x7F000001U, "opened"}}) {  // the T7 has no WiFi
    made.reset();
    served.reset();
    SimulatedLabjackT7::Options options;
    options.hardware = hardware;
    options.wifi_ip = wifi_ip;
    serve({}, options);
    const std::string message = refusal();
    EXPECT_TRUE(has(message, says)) << message;
  }
}

TEST_F(LabjackT7Driver, ErasedConstantsAreRefused) {
  SimulatedLabjackT7::Faults faults;
  faults.erased_flash = true;
  serve(faults);
  EXPECT_TRUE(has(refusal(), "calibration"));
}

TEST_F(LabjackT7Driver, RefusalsHaveLabJacksErrorText) {
  SimulatedLabjackT7::Faults faults;
  faults.refused = reg::stream_enable.address;
  faults.refused_code = 2607;
  serve(faults);
  const std::string message = refusal();
  EXPECT_TRUE(has(message, "STREAM_ENABLE")) << message;
  EXPECT_TRUE(has(message, "2607, the scan list is invalid")) << message;
  EXPECT_TRUE(has(message, settings.command.text())) << message;
}

// If LAST_ERR_DETAIL is 0, the T7 has no further explanation of an error.
TEST_F(LabjackT7Driver, RefusalsWithoutDetailHaveNoErrorText) {
  SimulatedLabjackT7::Faults faults;
  faults.refused = reg::stream_enable.address;
  faults.refused_code = 0;
  serve(faults);
  const std::string message = refusal();
  EXPECT_TRUE(has(message, "STREAM_ENABLE")) << message;
  EXPECT_FALSE(has(message, "LabJack error")) << message;
}

TEST_F(LabjackT7Driver, ErrorNamesTheAddressIfNobodyAnswers) {
  serve({});
  served.reset();
  const std::string message = refusal();
  EXPECT_TRUE(has(message, settings.command.text())) << message;
}

}  // namespace
}  // namespace mdof::drivers::labjack_t7::test
