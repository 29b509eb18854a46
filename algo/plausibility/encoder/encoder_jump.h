// A sudden gain or loss of counts of the encoder.
#pragma once

#include <cstdint>
#include <optional>
#include <span>

namespace mdof::algo {

struct EncoderJump {
  std::int64_t time_ns = 0;
  double position_m = 0;  // before the jump
  double size_m = 0;
};

// The largest step of the encoder in rows `first` to `last` that no axis can make: larger than
// `least_m`, between two scans, with the same speed before and after, and with more than 10 m/s².
// The other rows are needed as neighbours: five before and five after. Spikes of one sample are
// removed by the median of three, and the size is correct at any steady speed; during acceleration
// its error is up to twice the change of travel per scan. At less than about 150 Hz an axis can
// make a step of 100 µm, so no jump is found.
std::optional<EncoderJump> find_jump(std::span<const std::int64_t> time_ns,
                                     std::span<const double> encoder_m, std::size_t first,
                                     std::size_t last, std::int64_t period_ns, double least_m);

}  // namespace mdof::algo
