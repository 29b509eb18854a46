// The simulated machine and its sensors. The readings of a scan depend only on the options and on
// the number of the scan.
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

// Calculates the displacement of the target along each probe, in the order of the rig, for a travel
// and the five errors. The caller supplies this function, because drivers do not include algo/.
using ForwardModel =
    std::function<void(double travel_m, const Errors5& local, std::span<double> probe_m)>;

class Machine {
 public:
  // `options`: fit_to_rig() has completed them.
  Machine(Rig rig, SimulatorOptions options, ForwardModel model);

  // The channels: the probes in the order of the rig, as raw readings in µm before the calibration;
  // then the encoder, in mm.
  std::vector<Channel> channels() const;
  // Appends one value and one quality to each channel. The caller has prepared the columns before
  // and adds the time. `t_ns`: time of the scan since the start.
  void append_scan(SampleBlock& block, std::uint64_t scan, std::int64_t t_ns);
  bool in_gap(std::int64_t t_ns) const;  // whether a scan at t_ns is never sent

  // True errors of the target, in the local frame; the reference point is the origin of the
  // carriage. They are calculated from the errors of the moving body in the options.
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
  std::vector<double> probe_m_;  // working memory of append_scan()
};

}  // namespace mdof::drivers
