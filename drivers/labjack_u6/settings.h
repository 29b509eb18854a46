// Checked settings of a U6, from the keys of its table.
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
  int ain = -1;                  // number of the AIN; -1: a quadrature counter
  double um_per_count = 0;       // counter only
  double most_counts_per_s = 0;  // highest counting rate without loss of counts; 0: not checked
  int gain = 0;                  // AIN only: range 10 V / 10^gain
  bool differential = false;     // even AIN only: measured relative to the next AIN
  int fio = 0;                   // counter only: first line; the counter also uses the next line
};

struct Settings {
  std::string name;    // name of the device
  std::string serial;  // "": exactly one device must be connected
  double rate_hz = 1000;
  int resolution_index = 0;  // 0: the device's default
  int settling_10us = 0;     // 0: automatic
  std::vector<Input> inputs;
  EncoderOrigin encoder;
};

// The scan list for these inputs, in the same order; a counter has two entries.
std::vector<Entry> scan_list(const std::vector<Input>& inputs);

// A packet contains the samples of 20 ms, but at most 25 samples. Only full packets can share a
// transfer. A transfer contains the data of 5 ms. Transfers for 0.25 s are pending at any time, so
// that the host empties the small buffer of the device even while it is busy.
int samples_per_packet(double samples_hz);
usb::InStream::Options transfers_for(double samples_hz);

}  // namespace mdof::drivers::labjack_u6
