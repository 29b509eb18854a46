// What a T7 is configured to do: the keys of its table, checked.
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
  double most_counts_per_s = 0;  // of the counter, without losing any; 0: not watched
  int negative = -1;             // of a differential input: the AIN it is measured against
  double range_v = 0;            // of its own; 0: that of all
  int dio = 0;                   // of the counter: its even line; its second is the next
};

struct Settings {
  std::string name;  // of the device
  Endpoint command, stream;
  double rate_hz = 1000;
  double range_v = 10;
  int resolution_index = 0;            // 0: the device's default
  double settling_us = 0;              // 0: the device chooses
  std::size_t samples_per_packet = 0;  // whole scans
  std::uint32_t serial = 0;            // 0: any
  std::vector<Input> inputs;
  EncoderOrigin encoder;
  std::map<std::string, EncoderOrigin> further_encoders;  // of further axes, by channel
};

// The scan list for these inputs, in their order; a counter takes two entries.
std::vector<int> scan_list(const std::vector<Input>& inputs);
// Whole scans for about 4 ms, so that a sample waits no longer for its packet, and packets are few:
// each wakes two threads.
std::size_t quick_packet(double rate_hz, std::size_t words_per_scan);

}  // namespace mdof::drivers::labjack_t7
