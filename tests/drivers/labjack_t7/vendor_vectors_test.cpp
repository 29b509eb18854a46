// Compares the driver and its simulated device with LabJack's register map for LJM. Source:
// labjack/ljm_constants, LabJack/LJM/ljm_constants.json, "registers" (name, address, type,
// default).
#include <gtest/gtest.h>

#include "drivers/labjack_t7/simulated_labjack_t7.h"
#include "tests/drivers/vendor_vector.h"

namespace mdof::drivers::labjack_t7 {
namespace {

using modbus::bytes;

constexpr const char* kMap = "labjack/ljm_constants, LabJack/LJM/ljm_constants.json, registers";

class LabjackT7Vectors : public testing::Test {
 protected:
  std::string ask(const char* hex) { return device.exchange(0, 1, bytes(hex), 0); }
  SimulatedLabjackT7 device{[](std::size_t, std::int64_t) { return 0; }, {}};
};

TEST_F(LabjackT7Vectors, AddressesAreThoseOfLabJacksMap) {
  struct Row {
    Register is;
    const char* name;
    int address;
  };
  const Row rows[] = {
      {reg::ain + 2 * 13, "AIN13", 26},
      {reg::dio_ef_read_a, "DIO0_EF_READ_A", 3000},
      {reg::dio_ef_read_a + 2 * 6, "DIO6_EF_READ_A", 3012},
      {reg::capture_16, "STREAM_DATA_CAPTURE_16", 4899},
      {reg::stream_rate, "STREAM_SCANRATE_HZ", 4002},
      {reg::stream_addresses, "STREAM_NUM_ADDRESSES", 4004},
      {reg::stream_samples, "STREAM_SAMPLES_PER_PACKET", 4006},
      {reg::stream_settling, "STREAM_SETTLING_US", 4008},
      {reg::stream_resolution, "STREAM_RESOLUTION_INDEX", 4010},
      {reg::stream_buffer, "STREAM_BUFFER_SIZE_BYTES", 4012},
      {reg::stream_clock_source, "STREAM_CLOCK_SOURCE", 4014},
      {reg::stream_target, "STREAM_AUTO_TARGET", 4016},
      {reg::stream_data_type, "STREAM_DATATYPE", 4018},
      {reg::stream_scans, "STREAM_NUM_SCANS", 4020},
      {reg::stream_start_time, "STREAM_START_TIME_STAMP", 4026},
      {reg::stream_no_recovery, "STREAM_AUTORECOVER_DISABLE", 4028},
      {reg::stream_scan_list, "STREAM_SCANLIST_ADDRESS0", 4100},
      {reg::stream_enable, "STREAM_ENABLE", 4990},
      {reg::ain_range, "AIN0_RANGE", 40000},
      {reg::ain_range + 2 * 13, "AIN13_RANGE", 40026},  // AIN#(0:249)_RANGE, FLOAT32
      {reg::ain_negative_ch, "AIN0_NEGATIVE_CH", 41000},
      {reg::ain_negative_ch + 12, "AIN12_NEGATIVE_CH", 41012},  // AIN#(0:249)_NEGATIVE_CH, UINT16
      {reg::ain_all_range, "AIN_ALL_RANGE", 43900},
      {reg::ain_all_negative_ch, "AIN_ALL_NEGATIVE_CH", 43902},
      {reg::dio_ef_enable, "DIO0_EF_ENABLE", 44000},
      {reg::dio_ef_index, "DIO0_EF_INDEX", 44100},
      {reg::dio_ef_index + 2 * 6, "DIO6_EF_INDEX", 44112},
      {reg::wifi_ip, "WIFI_IP", 49200},
      {reg::last_error, "LAST_ERR_DETAIL", 55000},
      {reg::test, "TEST", 55100},
      {reg::product_id, "PRODUCT_ID", 60000},
      {reg::firmware, "FIRMWARE_VERSION", 60004},
      {reg::hardware_installed, "HARDWARE_INSTALLED", 60010},
      {reg::serial, "SERIAL_NUMBER", 60028},
      {reg::core_timer, "CORE_TIMER", 61520},
      {reg::flash_pointer, "INTERNAL_FLASH_READ_POINTER", 61810},
      {reg::flash_read, "INTERNAL_FLASH_READ", 61812},
  };
  for (const Row& row : rows) EXPECT_EQ(row.is.address, row.address) << row.name << ": " << kMap;
}

TEST_F(LabjackT7Vectors, SimulatedDeviceAnswersAsInTheMap) {
  const VendorVector vectors[] = {
      {"TEST is 0x00112233", "00 02 00 00 00 06 01 03 D7 3C 00 02",
       "00 02 00 00 00 07 01 03 04 00 11 22 33", kMap},
      {"PRODUCT_ID is the float 7", "00 03 00 00 00 06 01 03 EA 60 00 02",
       "00 03 00 00 00 07 01 03 04 40 E0 00 00", kMap},
      {"STREAM_START_TIME_STAMP is 0 before the first scan", "00 04 00 00 00 06 01 03 0F BA 00 02",
       "00 04 00 00 00 07 01 03 04 00 00 00 00", kMap},
      {"LAST_ERR_DETAIL is one register", "00 05 00 00 00 06 01 03 D6 D8 00 01",
       "00 05 00 00 00 05 01 03 02 00 00", kMap},
      {"AIN0 is a float", "00 06 00 00 00 06 01 03 00 00 00 02",
       "00 06 00 00 00 07 01 03 04 00 00 00 00", kMap},
  };
  for (const VendorVector& vector : vectors)
    EXPECT_EQ(mismatch(ask(vector.request), vector.reply), "") << vector;
}

// "For base differential channels, positive must be an even channel from 0-12 and negative must be
// positive+1". AIN_ALL_NEGATIVE_CH and AIN_ALL_RANGE write the registers of all inputs.
TEST_F(LabjackT7Vectors, EachInputHasItsRangeAndNegativeChannel) {
  const VendorVector vectors[] = {
      {"AIN_ALL_NEGATIVE_CH = 199", "00 07 00 00 00 09 01 10 AB 7E 00 01 02 00 C7",
       "00 07 00 00 00 06 01 10 AB 7E 00 01", kMap},
      {"AIN_ALL_RANGE = 10.0", "00 08 00 00 00 0B 01 10 AB 7C 00 02 04 41 20 00 00",
       "00 08 00 00 00 06 01 10 AB 7C 00 02", kMap},
      {"AIN2_NEGATIVE_CH = 3", "00 09 00 00 00 09 01 10 A0 2A 00 01 02 00 03",
       "00 09 00 00 00 06 01 10 A0 2A 00 01", kMap},
      {"AIN2_RANGE = 1.0", "00 0A 00 00 00 0B 01 10 9C 44 00 02 04 3F 80 00 00",
       "00 0A 00 00 00 06 01 10 9C 44 00 02", kMap},
      {"AIN1_NEGATIVE_CH to AIN3_NEGATIVE_CH", "00 0B 00 00 00 06 01 03 A0 29 00 03",
       "00 0B 00 00 00 09 01 03 06 00 C7 00 03 00 C7", kMap},
      {"AIN1_RANGE, AIN2_RANGE", "00 0C 00 00 00 06 01 03 9C 42 00 04",
       "00 0C 00 00 00 0B 01 03 08 41 20 00 00 3F 80 00 00", kMap},
  };
  for (const VendorVector& vector : vectors)
    EXPECT_EQ(mismatch(ask(vector.request), vector.reply), "") << vector;
}

// Sources: ljm_constants.json, "errors". For register index 10 and bit 1 of HARDWARE_INSTALLED:
// the descriptions of these registers.
TEST_F(LabjackT7Vectors, NumbersAreThoseOfLabJacksConstants) {
  EXPECT_EQ(status::recovering, 2940);         // STREAM_AUTO_RECOVER_ACTIVE
  EXPECT_EQ(status::recovered, 2941);          // STREAM_AUTO_RECOVER_END
  EXPECT_EQ(status::scan_overlap, 2942);       // STREAM_SCAN_OVERLAP
  EXPECT_EQ(status::recovery_overflow, 2943);  // STREAM_AUTO_RECOVER_END_OVERFLOW
  EXPECT_EQ(status::burst_complete, 2944);     // STREAM_BURST_COMPLETE
  EXPECT_EQ(status::buffer_full, 2945);        // STREAM_BUFFER_FULL
  for (const int code : {2605, 2606, 2607, 2608, 2618, 2620, 2625, 2940, 2945})
    EXPECT_TRUE(error_text(code).starts_with("LabJack error " + std::to_string(code) + ", "));
  EXPECT_EQ(kQuadrature, 10U);
  EXPECT_EQ(kHasWifi, 2U);
  EXPECT_EQ(kSingleEnded, 199);
  EXPECT_EQ(kAins, 14);
  EXPECT_EQ(kCore_Hz, 40e6);
  EXPECT_EQ(kMostSamples, 512U);
  EXPECT_EQ(kTestValue, 0x00112233U);
}

// The calibration of a T7. Each read returns 13 floats, and the blocks begin at 0x3C4000
// (LabJack's example stream.c).
TEST_F(LabjackT7Vectors, FlashIsReadBlockByBlock) {
  const std::uint32_t addresses[] = {0x3C4000, 0x3C4034, 0x3C4068, 0x3C409C};
  for (int block = 0; block < 4; ++block) EXPECT_EQ(flash_address(block), addresses[block]);
}

}  // namespace
}  // namespace mdof::drivers::labjack_t7
