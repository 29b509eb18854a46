// Checked settings of a USB-1608FS-Plus, from the keys of its table.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "drivers/driver.h"
#include "drivers/mcc_usb1608fs_plus/protocol.h"
#include "drivers/usb/in_stream.h"
#include "schema/sample.h"

namespace mdof::drivers::mcc_usb1608fs_plus {

struct Input {
  Channel channel;
  std::size_t input = 0;  // n of the input CHn
};

struct Settings {
  std::string name;    // name of the device
  std::string serial;  // "": exactly one device must be connected
  double rate_hz = 1000;
  Range range = kRanges.front();
  // In the order of the configuration; the device sends the inputs in the order of their numbers.
  std::vector<Input> inputs;
  EncoderOrigin encoder = {};  // valid if an input is the encoder, in volts
};

std::uint8_t mask_of(const std::vector<Input>& inputs);
// A transfer contains the data of 5 ms. Transfers for 0.25 s are pending at any time.
usb::InStream::Options transfers_for(double samples_hz);
ScanSetup scan_setup(const Settings& settings);

}  // namespace mdof::drivers::mcc_usb1608fs_plus
