// A fixture and a target as they truly are, off their nominal ones, and what its probes read.
// Local frame of the axis; m and rad.
#pragma once

#include <Eigen/Core>
#include <array>
#include <span>
#include <vector>

#include "algo/model/fixture.h"
#include "algo/sensitivity/plan/draws.h"
#include "schema/study/plan.h"

namespace mdof::algo {

struct ProbeDeviation {
  Eigen::Vector3d shift = Eigen::Vector3d::Zero();
  // Moved by circle_m across its direction, to the side at circle_turns (the paper's Eq. 13-15).
  double circle_m = 0, circle_turns = 0;
  Eigen::Vector3d turn = Eigen::Vector3d::Zero();
  double tilt_rad = 0, tilt_turns = 0;  // by tilt_rad to the side at tilt_turns
  double gain = 1, zero_m = 0, drift_m = 0;
};
struct PartDeviation {
  Eigen::Vector3d shift = Eigen::Vector3d::Zero(), turn = Eigen::Vector3d::Zero();
};
// The height of the plane at its point c is flatness_m / 2 · Σ w_k sin 2π(k c·e_k / L + phase_k) of
// the waves k = 1 ... kFlatnessWaves. L is the longest wave (flatness_length_m); the w_k sum to 1,
// so that no two heights differ by more than flatness_m.
struct PlaneDeviation {
  Eigen::Vector3d turn = Eigen::Vector3d::Zero();
  double map_scale = 1, flatness_m = 0;
  std::array<double, kFlatnessWaves> along{}, across{};  // e_k: direction of wave k in the plane
  std::array<double, kFlatnessWaves> phase_turns{};
};
struct Mounting {
  std::vector<ProbeDeviation> probe;
  std::array<PartDeviation, 3> part{};                 // by Part
  std::array<PlaneDeviation, 3> plane{};               // by Part; fixture: none
  double fixture_expansion = 0, target_expansion = 0;  // share of each length, at the reading
};

// The fixture of one trial at a time. `course` says how far the trial is: 0 when the probes are
// zeroed, 1 when all of the drift and the warming has come.
class MountedFixture {
 public:
  MountedFixture(const Fixture& nominal, Forward forward, double flatness_length_m);

  // False: an angle is beyond what the models take (0.25 rad).
  bool mount(const Mounting& mounting);
  // What the probes show: gain (displacement - zero) + zero error + drift. The zero is what
  // mounting adds to the reading at d = 0 without errors of motion, or 0. False as mount().
  bool read(double travel_m, const Errors5& local, double course, bool zero_at_start,
            std::span<double> reading_m);
  std::size_t probes() const { return nominal_.probes.size(); }

 private:
  void warm(double course);
  double height(std::size_t probe, double travel_m, const Errors5& local) const;
  bool displacements(double travel_m, const Errors5& local, std::span<double> out);

  Fixture nominal_;
  Fixture cold_;  // as mounted
  Fixture now_;   // warmed
  Forward forward_;
  double flatness_length_m_;
  std::vector<Part> part_;                       // of each probe: top, side or neither
  std::vector<Eigen::Vector3d> first_, second_;  // across each nominal direction
  Mounting mounting_;
  std::vector<double> nominal_zero_m_, zero_m_;  // readings at d = 0: as planned, as mounted
};

Part part_of(const FixtureProbe& probe);

}  // namespace mdof::algo
