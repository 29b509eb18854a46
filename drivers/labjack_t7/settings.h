// Checked settings of a T7, from the keys of its table.
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
  int ain = -1;                  // number of the AIN; -1: a quadrature counter
  double um_per_count = 0;       // counter only
  double most_counts_per_s = 0;  // highest counting rate without loss of counts; 0: not checked
  int negative = -1;   // number of the negative AIN of a differential input; -1: single-ended
  double range_v = 0;  // 0: Settings::range_v applies
  int dio = 0;         // counter only: even line; the counter also uses the next line
};

struct Settings {
  std::string name;  // name of the device
  Endpoint command, stream;
  double rate_hz = 1000;
  double range_v = 10;
  int resolution_index = 0;            // 0: the device's default
  double settling_us = 0;              // 0: automatic
  std::size_t samples_per_packet = 0;  // a multiple of the scan's samples
  std::uint32_t serial = 0;            // 0: any serial number is accepted
  std::vector<Input> inputs;
  EncoderOrigin encoder;
  // For further axes, by the name of the channel.
  std::map<std::string, EncoderOrigin> further_encoders;
};

// The scan list for these inputs, in the same order; a counter has two entries.
std::vector<int> scan_list(const std::vector<Input>& inputs);
// Returns the number of samples in a packet that contains whole scans of about 4 ms. A sample then
// waits at most 4 ms for its packet. Shorter packets would be too many: each packet wakes two
// threads.
std::size_t quick_packet(double rate_hz, std::size_t words_per_scan);

}  // namespace mdof::drivers::labjack_t7
