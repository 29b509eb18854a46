// What a U6 is configured to do: the keys of its table, checked.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "drivers/driver.h"
#include "drivers/labjack_u6/protocol.h"
#include "drivers/usb/in_stream.h"
#include "schema/sample.h"

namespace mdof::drivers::labjack_u6 {

struct Input {
  Channel channel;
  int ain = -1;                  // -1: a quadrature counter
  double um_per_count = 0;       // of the counter
  double most_counts_per_s = 0;  // of the counter, without losing any; 0: not watched
  int gain = 0;                  // of an AIN: range 10 V / 10^gain
  bool differential = false;     // of an even AIN: measured against the one after it
  int fio = 0;                   // of the counter: its first line; its second is the next
};

struct Settings {
  std::string name;    // of the device
  std::string serial;  // "": the only one there is
  double rate_hz = 1000;
  int resolution_index = 0;  // 0: the device's default
  int settling_10us = 0;     // 0: the device chooses
  std::vector<Input> inputs;
  EncoderOrigin encoder;
};

// The scan list for these inputs, in their order; a counter takes two entries.
std::vector<Entry> scan_list(const std::vector<Input>& inputs);

// A packet holds what comes in 20 ms, at most 25 samples; only full packets may share a transfer.
// Transfers bring what comes in 5 ms and a quarter of a second of them waits, so that the device's
// small buffer is emptied while the host is busy.
int samples_per_packet(double samples_hz);
usb::InStream::Options transfers_for(double samples_hz);

}  // namespace mdof::drivers::labjack_u6
