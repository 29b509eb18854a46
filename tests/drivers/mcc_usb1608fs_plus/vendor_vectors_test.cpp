// Requests that Measurement Computing's driver (mccdaq/uldaq) sends, and replies that it reads.
#include <gtest/gtest.h>

#include "drivers/mcc_usb1608fs_plus/simulated_mcc_usb1608fs_plus.h"
#include "tests/drivers/vendor_vector.h"

namespace mdof::drivers::mcc_usb1608fs_plus {
namespace {

using modbus::bytes;

class Usb1608Vectors : public testing::Test {
 protected:
  usb::Answer report(std::uint8_t request, const std::string& out) {
    return device.control({0x40, request, 0, 0, static_cast<std::uint16_t>(out.size())}, out, 0)
        .answer;
  }
  std::string ask(std::uint8_t request, std::uint16_t value, std::uint16_t length) {
    return device.control({0xC0, request, value, 0, length}, "", 0).bytes;
  }
  SimulatedMccUsb1608fsPlus device{
      [](std::size_t input, std::int64_t) { return input == 2 ? 5.0 : -10.0; }, {}};
};

// Sources: src/usb/Usb1608fsPlus.cpp: setScanRunningBitMask 0x0002, setOverrunBitMask 0x0004.
// src/usb/UsbDaqDevice.cpp: request 0x44, CMD_STATUS_KEY.
TEST_F(Usb1608Vectors, StatusBitsEqualTheVendors) {
  EXPECT_EQ(mismatch(ask(0x44, 0, 2), "00 00"), "");
  // CMD_AINSCAN_START is 0x11. Its data are TAINSCAN_CFG of src/usb/ai/AiUsb1608fsPlus.h:
  // - scan_count
  // - pacer_period (u32): 40 MHz / 1 kHz - 1
  // - chan_mask
  // - options: 0x80 means that the endpoint does not stall (getOptionsCode)
  EXPECT_EQ(report(0x11, bytes("00 00 00 00 3F 9C 00 00 07 80")), usb::Answer::done);
  EXPECT_EQ(mismatch(ask(0x44, 0, 2), "02 00"), "");
  EXPECT_EQ(report(0x12, ""), usb::Answer::done);  // CMD_AINSTOP
  EXPECT_EQ(mismatch(ask(0x44, 0, 2), "00 00"), "");
}

// CMD_AINSCAN_CONFIG is 0x14. Its data are a range code for each input (mapRangeCode: 0, 1, 3, 5
// for 10, 5, 2, 1 V). Samples arrive on endpoint 0x81. They have 16 bits, little-endian, and begin
// with the lowest channel (processScanData16).
TEST_F(Usb1608Vectors, SamplesHaveTheVendorsFormat) {
  EXPECT_EQ(report(0x14, bytes("00 00 00 00 00 00 00 00")), usb::Answer::done);
  EXPECT_EQ(report(0x11, bytes("00 00 00 00 3F 9C 00 00 06 81")), usb::Answer::done);
  const std::string samples = device.in(0x81, 64, 1'500'000).bytes;
  EXPECT_EQ(mismatch(samples, "00 00 00 C0"), "");
}

// src/usb/ai/AiUsb1608fsPlus.cpp, getCalCoefIndex: index = 8 inputs x range code + input. Each
// pair is a slope and an offset, both floats. Request 0x30 (CMD_MEM_CAL_KEY) reads the memory at
// the address in its value.
TEST_F(Usb1608Vectors, ConstantsHaveTheVendorsAddresses) {
  EXPECT_EQ(calibration_address(0, 0), 0);
  EXPECT_EQ(calibration_address(5, 3), 8 * (8 * 5 + 3));
  EXPECT_EQ(mismatch(ask(0x30, 8 * (8 * 3 + 1), 8), "00 00 80 3F 00 00 00 00"), "");
  EXPECT_EQ(device.identity().vendor, 0x09DB);
  EXPECT_EQ(device.identity().product, 0x00EA);
}

// src/usb/UsbDaqDevice.cpp: vendor 0x09db. src/usb/Usb1608fsPlus.cpp and AiUsb1608fsPlus.cpp:
// product 0x00ea, eight inputs, a serial number of 8 characters, 100 kS/s per input and 400 kS/s
// in total.
TEST_F(Usb1608Vectors, NumbersEqualTheVendors) {
  EXPECT_EQ(kVendor, 0x09DB);
  EXPECT_EQ(kProduct, 0x00EA);
  EXPECT_EQ(kSamplesIn, 0x81);
  EXPECT_EQ(kInputs, 8U);
  EXPECT_EQ(kSerialBytes, 8U);
  EXPECT_EQ(kPacket, 64U);
  EXPECT_EQ(kMostRate_Hz, 100e3);
  EXPECT_EQ(kMostSamples_Hz, 400e3);
}

}  // namespace
}  // namespace mdof::drivers::mcc_usb1608fs_plus
