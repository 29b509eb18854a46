// Trials of one axis of a plan, from the random numbers to the solved errors. A trial has one
// point, or a series of positions along the axis, or both.
#pragma once

#include <array>
#include <cstddef>
#include <limits>
#include <string>
#include <vector>

#include "algo/model/solver.h"
#include "algo/sensitivity/plan/draws.h"
#include "algo/sensitivity/plan/mounting.h"
#include "schema/base/result.h"
#include "schema/study/plan.h"

namespace mdof::algo {

inline constexpr double kNotSolved = std::numeric_limits<double>::quiet_NaN();

// Readings and errors of the trials of one request. Reading 0 is the point; readings 1 ... are the
// series. Unless stated, the order of the elements is [reading][trial].
struct AxisReadings {
  std::size_t n = 0, probes = 0;
  std::vector<double> truth, estimate;      // [reading][error][trial], local frame; kNotSolved
                                            // without a solution
  std::vector<double> travel_m, encoder_m;  // true travel, and travel of the encoder
  std::vector<double> probe_m;              // [reading][probe][trial]
  std::vector<double> square_rad;           // [trial]: error of the angle of the artefact

  std::size_t at(std::size_t reading, std::size_t error) const {
    return (reading * kErrorCount + error) * n;
  }
};

class PlanAxis {
 public:
  // `point`, `series`: whether the point and the series are needed.
  static Result<PlanAxis> create(const StudyPlan& plan, const Rig& rig, const std::string& prefix,
                                 bool point, bool series, std::vector<std::string>& causes);

  // Thread-safe. Resizes `out`.
  void run(const DrawRequest& request, AxisReadings& out) const;

  // True errors of one trial as waves along the axis: amplitudes, and phases in turns.
  struct TrueErrors {
    Errors5 amplitude{};
    std::array<double, 5> phase_turns{};
    Errors5 at(double travel_m, double period_m) const;  // local frame
  };
  // Sets the mounting and the true errors of trial j of `numbers`.
  void deviate(const DrawnNumbers& numbers, std::size_t j, Mounting& mounting,
               TrueErrors& truth) const;
  Mounting nominal_mounting() const;

  const PlanDraws& draws() const { return draws_; }
  const Solver& solver() const { return solver_; }
  Axis axis() const { return solver_.fixture().axis; }
  std::size_t positions() const { return positions_; }
  double period_m() const { return period_m_; }
  double flatness_length_m() const { return flatness_length_m_; }

 private:
  struct Trial;
  PlanAxis(Solver solver, PlanDraws draws);
  void simulate(const DrawnNumbers& numbers, std::size_t j, MountedFixture& fixture,
                Mounting& mounting, AxisReadings& out) const;
  void read(const Trial& trial, std::size_t reading, MountedFixture& fixture,
            AxisReadings& out) const;
  void solve(AxisReadings& out, std::size_t reading) const;
  bool needed(std::size_t reading) const { return reading == 0 ? point_ : positions_ > 0; }

  Solver solver_;
  PlanDraws draws_;
  Forward forward_ = Forward::rigid;
  bool zero_at_start_ = true, point_ = true;
  std::size_t positions_ = 0;  // positions of a series; 0: no series
  double from_m_ = 0, to_m_ = 0, period_m_ = 0, flatness_length_m_ = 0;
  double fixture_per_K_ = 0, target_per_K_ = 0;
};

}  // namespace mdof::algo
