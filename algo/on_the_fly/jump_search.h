// Finds jumps of the encoder's count in the frames of an axis that moves without stopping.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "algo/plausibility/encoder/encoder_jump.h"
#include "algo/plausibility/noise_floor.h"
#include "schema/sample.h"

namespace mdof::algo {

// The result does not depend on how the frames are divided into blocks. Each frame must have a
// position.
class JumpSearch {
 public:
  // Takes the rows first ... last - 1. A jump is above 20 µm and above 60 standard deviations of
  // the encoder's noise.
  void push(const FrameBlock& frames, std::size_t first, std::size_t last);
  void flush();

  // In the order of time, without jumps that were reversed within a second. Only the first 1,000.
  const std::vector<EncoderJump>& jumps() const { return jumps_; }

 private:
  void search();
  void take(const EncoderJump& jump, double least_m);

  std::vector<std::int64_t> time_ns_;
  std::vector<double> encoder_m_;
  NoiseFloor noise_;
  std::int64_t period_ns_ = 0;
  std::vector<EncoderJump> jumps_;
};

}  // namespace mdof::algo
