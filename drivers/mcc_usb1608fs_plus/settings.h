// What a USB-1608FS-Plus is configured to do: the keys of its table, checked.
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
  std::size_t input = 0;  // CHn
};

struct Settings {
  std::string name;    // of the device
  std::string serial;  // "": the only one there is
  double rate_hz = 1000;
  Range range = kRanges.front();
  std::vector<Input> inputs;   // in the order of the configuration; the device's is by number
  EncoderOrigin encoder = {};  // where an input gives its volts
};

std::uint8_t mask_of(const std::vector<Input>& inputs);
// Of a transfer: what comes in 5 ms; a quarter of a second of them waits.
usb::InStream::Options transfers_for(double samples_hz);
ScanSetup scan_setup(const Settings& settings);

}  // namespace mdof::drivers::mcc_usb1608fs_plus
