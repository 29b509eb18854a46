// Position of the axis at any time: forward through all targets, past the end, and back, repeated
// endlessly.
//
// A move over D is the minimum-jerk polynomial s(τ) = D (10 τ³ - 15 τ⁴ + 6 τ⁵). Its highest speed
// is 1.875 D/T and its highest acceleration 10/√3 D/T²; they determine the time T. The axis rests
// at targets only; at the overruns it turns without a pause.
#pragma once

#include <cstdint>
#include <vector>

#include "drivers/simulator/options.h"

namespace mdof::drivers {

struct AxisState {
  double travel_m = 0;
  int direction = 1;     // +1, -1: direction of this move or, at rest, of the last move
  bool resting = false;  // at a target
};

class Motion {
 public:
  // Targets ascend and are not empty.
  explicit Motion(const SimulatorOptions& options);

  AxisState at(std::int64_t time_ns) const;  // time_ns >= 0
  // One cycle is forward and back; cycles repeat exactly.
  std::int64_t cycle_ns() const { return leg_.back().begin_ns + leg_.back().length_ns; }

 private:
  struct Leg {  // a move, or a rest if from == to
    std::int64_t begin_ns, length_ns;
    double from_m, to_m;
    int direction;
    bool rest;
  };
  void append(double to_m, int direction, bool rest, double seconds);
  void move_to(double to_m, int direction);
  double settling_m(const Leg& leg, double since_s) const;

  double speed_m_s_, acceleration_m_s2_;
  double settle_m_, settle_hz_, settle_s_;
  double position_m_;  // end of the last leg
  std::vector<Leg> leg_;
};

}  // namespace mdof::drivers
