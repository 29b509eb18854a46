// Position of the axis as a function of time. The axis moves forward through all targets, beyond
// the last target, and back. It repeats this cycle.
//
// A move over the distance D in the time T is the minimum-jerk polynomial
// s(τ) = D (10 τ³ - 15 τ⁴ + 6 τ⁵), τ = t/T.
// Its highest speed is 1.875 D/T, its highest acceleration 10/√3 D/T². The time T follows from the
// limits of speed and acceleration. The axis rests only at targets; beyond the last target it turns
// without a pause.
#pragma once

#include <cstdint>
#include <vector>

#include "drivers/simulator/options.h"

namespace mdof::drivers {

struct AxisState {
  double travel_m = 0;
  int direction = 1;     // +1, -1: direction of this move; at rest, direction of the last move
  bool resting = false;  // true: the axis is at rest at a target
};

class Motion {
 public:
  // The targets must ascend; there is at least one.
  explicit Motion(const SimulatorOptions& options);

  AxisState at(std::int64_t time_ns) const;  // time_ns >= 0
  // Duration of one cycle, forward and back. All cycles are equal.
  std::int64_t cycle_ns() const { return leg_.back().begin_ns + leg_.back().length_ns; }

 private:
  struct Leg {  // a move; a rest if from_m == to_m
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
  double position_m_;  // position at the end of the last leg
  std::vector<Leg> leg_;
};

}  // namespace mdof::drivers
