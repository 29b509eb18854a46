// Checks that frames arrive at the rate that follows from the sample time. Pure.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <optional>

namespace mdof::drivers::capancdt {

// Another program may change the sample time. All time stamps would then be wrong. Thread-bound.
class RateWatch {
 public:
  explicit RateWatch(double frame_ns) : frame_ns_(frame_ns) {}

  // `frames`: number of frames when the newest frame was received, including lost frames. Returns
  // the measured duration of a frame if this duration deviates by more than 10 %, with the same
  // sign, in two successive stretches of time. A deviation in one stretch alone may come from a
  // delay of the network or of this computer.
  std::optional<double> add(std::int64_t frames, std::int64_t received_ns) {
    if (!begun_) begin(frames, received_ns);
    const auto passed_ns = static_cast<double>(received_ns - begun_ns_);
    const auto counted = static_cast<double>(frames - begun_frames_);
    if (passed_ns < std::max(kStretch_ns, kFewest * frame_ns_)) return std::nullopt;
    const double measured_ns = passed_ns / std::max(counted, 0.5);
    const double ratio = measured_ns / frame_ns_;
    const int off = ratio > 1 + kOff ? 1 : ratio < 1 - kOff ? -1 : 0;
    const bool again = off != 0 && off == off_;
    off_ = off;
    begin(frames, received_ns);
    return again ? std::optional(measured_ns) : std::nullopt;
  }

 private:
  static constexpr double kStretch_ns = 2e9, kFewest = 50, kOff = 0.1;
  void begin(std::int64_t frames, std::int64_t received_ns) {
    begun_ = true;
    begun_frames_ = frames;
    begun_ns_ = received_ns;
  }
  double frame_ns_;
  bool begun_ = false;
  std::int64_t begun_frames_ = 0, begun_ns_ = 0;
  int off_ = 0;  // deviation in the previous stretch: 1: frames were too slow; -1: too fast
};

}  // namespace mdof::drivers::capancdt
