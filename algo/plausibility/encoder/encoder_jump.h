// Finds a jump of the encoder's count.
#pragma once

#include <cstdint>
#include <optional>
#include <span>

namespace mdof::algo {

struct EncoderJump {
  std::int64_t time_ns = 0;
  double position_m = 0;  // position before the jump
  double size_m = 0;
};

// Returns the largest step of the encoder in the rows `first` to `last` that an axis cannot make.
// Such a step is larger than `least_m`, is between two scans, has the same speed before and after,
// and requires an acceleration above 10 m/s². Six rows before and six rows after are also
// necessary. A median of three removes spikes of one sample. The size of the jump is correct at any
// steady speed; during acceleration its error is up to twice the change of travel per scan. At a
// rate below about 150 Hz an axis can make a step of 100 µm, so no jump is found. If up to three
// rows are missing in the log, the motion of the axis in the missing time is no jump.
std::optional<EncoderJump> find_jump(std::span<const std::int64_t> time_ns,
                                     std::span<const double> encoder_m, std::size_t first,
                                     std::size_t last, std::int64_t period_ns, double least_m);

}  // namespace mdof::algo
