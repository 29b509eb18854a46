// A count that the encoder lost or gained at once.
#pragma once

#include <cstdint>
#include <optional>
#include <span>

namespace mdof::algo {

struct EncoderJump {
  std::int64_t time_ns = 0;
  double position_m = 0;  // before it
  double size_m = 0;
};

// The largest step of the encoder in rows `first` to `last` of these that no axis makes: larger
// than `least_m`, between two scans, with the same speed before and after, and at over 10 m/s². The
// other rows are its neighbours, five before and five after are looked at. Single-sample spikes are
// voted out, and the size is right, at any steady speed; while the axis gains speed the size is off
// by up to twice what a scan adds to it. At less than about 150 Hz an axis can make a step of
// 100 µm, and none is found.
std::optional<EncoderJump> find_jump(std::span<const std::int64_t> time_ns,
                                     std::span<const double> encoder_m, std::size_t first,
                                     std::size_t last, std::int64_t period_ns, double least_m);

}  // namespace mdof::algo
