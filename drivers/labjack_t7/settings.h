// Settings of a T7: the checked keys of its table.
#pragma once

#include <cstdint>
#include <map>
#include <string>
#include <vector>

#include "drivers/driver.h"
#include "drivers/io/byte_stream.h"
#include "drivers/labjack_t7/protocol.h"
#include "schema/sample.h"

namespace mdof::drivers::labjack_t7 {

struct Input {
  Channel channel;
  int ain = -1;                  // -1: a quadrature counter
  double um_per_count = 0;       // of the counter
  double most_counts_per_s = 0;  // highest rate without loss of counts; 0: not checked
  int negative = -1;             // negative AIN of a differential input; -1: single-ended
  double range_v = 0;            // 0: the range of the device
  int dio = 0;                   // even line of the counter; the next line is its second
};

struct Settings {
  std::string name;  // of the device
  Endpoint command, stream;
  double rate_hz = 1000;
  double range_v = 10;
  int resolution_index = 0;            // 0: the device's default
  double settling_us = 0;              // 0: automatic
  std::size_t samples_per_packet = 0;  // whole scans
  std::uint32_t serial = 0;            // 0: any
  std::vector<Input> inputs;
  EncoderOrigin encoder;
  std::map<std::string, EncoderOrigin> further_encoders;  // of further axes, by channel
};

// The scan list for these inputs, in their order; a counter needs two entries.
std::vector<int> scan_list(const std::vector<Input>& inputs);
// Samples of whole scans for about 4 ms: a sample waits at most 4 ms for its packet, and there are
// not too many packets, each of which wakes two threads.
std::size_t quick_packet(double rate_hz, std::size_t words_per_scan);

}  // namespace mdof::drivers::labjack_t7
