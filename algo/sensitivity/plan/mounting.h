// A fixture and a target with deviations from their nominal geometry, and the readings of the
// probes. Local frame of the axis; m and rad.
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
  // Shift by circle_m perpendicular to the direction of the probe, at the azimuth circle_turns (Eq.
  // 13-15 of the paper).
  double circle_m = 0, circle_turns = 0;
  Eigen::Vector3d turn = Eigen::Vector3d::Zero();
  double tilt_rad = 0, tilt_turns = 0;  // tilt by tilt_rad at the azimuth tilt_turns
  double gain = 1, zero_m = 0, drift_m = 0;
};
struct PartDeviation {
  Eigen::Vector3d shift = Eigen::Vector3d::Zero(), turn = Eigen::Vector3d::Zero();
};
// The height of the plane at its point c is flatness_m / 2 · Σ w_k sin 2π(k c·e_k / L + phase_k)
// over the waves k = 1 ... kFlatnessWaves. L is the length of the longest wave (flatness_length_m).
// The sum of the w_k is 1, so two heights differ by at most flatness_m.
struct PlaneDeviation {
  Eigen::Vector3d turn = Eigen::Vector3d::Zero();
  double map_scale = 1, flatness_m = 0;
  std::array<double, kFlatnessWaves> along{}, across{};  // e_k: direction of wave k in the plane
  std::array<double, kFlatnessWaves> phase_turns{};
};
struct Mounting {
  std::vector<ProbeDeviation> probe;
  std::array<PartDeviation, 3> part{};                 // index: Part
  std::array<PlaneDeviation, 3> plane{};               // index: Part; unused for the fixture
  double fixture_expansion = 0, target_expansion = 0;  // relative expansion at course = 1
};

// Calculates the readings with the mounting of one trial. `course`: progress of the trial, from 0
// (probes are zeroed) to 1 (drift and thermal expansion are complete).
class MountedFixture {
 public:
  MountedFixture(const Fixture& nominal, Forward forward, double flatness_length_m);

  // False: an angle exceeds the limit of the models (0.25 rad).
  bool mount(const Mounting& mounting);
  // Readings of the probes: gain * (displacement - zero) + zero_m + drift_m * course. If
  // zero_at_start, `zero` is the contribution of the mounting to the displacement at d = 0 without
  // errors of motion; otherwise `zero` is 0. Returns false as mount() does.
  bool read(double travel_m, const Errors5& local, double course, bool zero_at_start,
            std::span<double> reading_m);
  std::size_t probes() const { return nominal_.probes.size(); }

 private:
  void warm(double course);
  double height(std::size_t probe, double travel_m, const Errors5& local) const;
  bool displacements(double travel_m, const Errors5& local, std::span<double> out);

  Fixture nominal_;
  Fixture cold_;  // with the deviations of the mounting
  Fixture now_;   // with these deviations and the expansion
  Forward forward_;
  double flatness_length_m_;
  std::vector<Part> part_;                       // of each probe: top, side or fixture
  std::vector<Eigen::Vector3d> first_, second_;  // two directions perpendicular to the nominal
                                                 // direction of each probe
  Mounting mounting_;
  // Displacements at d = 0: nominal; with the mounting.
  std::vector<double> nominal_zero_m_, zero_m_;
};

Part part_of(const FixtureProbe& probe);

}  // namespace mdof::algo
