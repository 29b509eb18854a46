// Settings of a U6: the checked keys of its table.
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
  double most_counts_per_s = 0;  // highest rate without loss of counts; 0: not checked
  int gain = 0;                  // AIN only: range 10 V / 10^gain
  bool differential = false;     // even AIN only: measured against the next AIN
  int fio = 0;                   // first line of the counter; the next line is its second
};

struct Settings {
  std::string name;    // of the device
  std::string serial;  // "": the only connected device
  double rate_hz = 1000;
  int resolution_index = 0;  // 0: the device's default
  int settling_10us = 0;     // 0: automatic
  std::vector<Input> inputs;
  EncoderOrigin encoder;
};

// The scan list for these inputs, in their order; a counter needs two entries.
std::vector<Entry> scan_list(const std::vector<Input>& inputs);

// A packet contains the samples of 20 ms, at most 25; only full packets can share a transfer. A
// transfer contains the data of 5 ms. Transfers for a quarter of a second are pending, so that the
// small buffer of the device is emptied while the host is busy.
int samples_per_packet(double samples_hz);
usb::InStream::Options transfers_for(double samples_hz);

}  // namespace mdof::drivers::labjack_u6
