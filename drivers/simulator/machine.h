// The simulated machine and its sensors: the readings of each scan are a pure function of its
// number.
#pragma once

#include <cstdint>
#include <functional>
#include <span>
#include <vector>

#include "drivers/simulator/motion.h"
#include "drivers/simulator/options.h"
#include "schema/axis.h"
#include "schema/rig/rig.h"
#include "schema/sample.h"

namespace mdof::drivers {

// Displacement of the target along each probe of the rig, in the rig's order, for this travel and
// these errors. The caller supplies it, because drivers do not include algo/.
using ForwardModel =
    std::function<void(double travel_m, const Errors5& local, std::span<double> probe_m)>;

class Machine {
 public:
  // `options`: completed by fit_to_rig().
  Machine(Rig rig, SimulatorOptions options, ForwardModel model);

  // The probes in the order of the rig, raw µm before the rig's calibration; then the encoder, mm.
  std::vector<Channel> channels() const;
  // Appends one value and quality to each channel; the caller has prepared the columns and adds the
  // time. `t_ns`: time of the scan since the start.
  void append_scan(SampleBlock& block, std::uint64_t scan, std::int64_t t_ns);
  bool in_gap(std::int64_t t_ns) const;  // whether the scan is never sent

  // Errors of the target at the carriage, local frame; the options give the errors of the moving
  // body.
  Errors5 truth_at(double travel_m, int direction) const;
  const Motion& motion() const { return motion_; }

 private:
  struct Reading {
    double um;
    Quality quality;
  };
  Reading probe_reading(std::size_t probe, std::uint64_t scan, std::int64_t t_ns,
                        double displacement_m) const;
  double encoder_mm(std::uint64_t scan, double travel_m) const;
  bool is_lost(std::size_t probe, std::int64_t t_ns) const;

  Rig rig_;
  SimulatorOptions options_;
  ForwardModel model_;
  Motion motion_;
  std::vector<double> probe_m_;  // scratch of append_scan
};

}  // namespace mdof::drivers
