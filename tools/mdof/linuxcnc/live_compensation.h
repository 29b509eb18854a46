// Live compensation for a user's configuration of LinuxCNC: calculates safe limits, and writes the
// HAL lines that connect the component mdof_compensation between motion and drives.
#pragma once

#include <string>
#include <vector>

#include "schema/base/result.h"
#include "tools/mdof/linuxcnc/configuration.h"

namespace mdof::tools {

inline constexpr const char* kCompensationHal = "mdof_compensation.hal";

struct LiveJoint {
  char axis = 'X';
  int joint = 0;
  bool second = false;  // The second joint of an axis with two joints, as in a gantry.
};

// Lengths are in machine units (mm or inch), times in s.
struct LiveCompensation {
  bool inch = false;
  std::vector<LiveJoint> joints;
  double max_offset = 0, max_velocity = 0, max_acceleration = 0, fade_velocity = 0;
  std::string offset_reason, velocity_reason;  // How max_offset and max_velocity were derived.
  std::string hal;                             // Content of the file kCompensationHal.
};

struct LiveRequest {
  double margin_mm = 0.1;  // Smallest distance between a soft limit and the hard stop of the axis.
  std::string socket;
  bool simulated = false, despite_warnings = false;
  // Accepts tables of one approach; the component then applies these values in both directions.
  bool one_approach = false;
};

// Error (bad_input): a setting is unsafe. The message lists section and key of each unsafe setting.
Result<LiveCompensation> live_compensation(const LinuxCncIni& ini, const HalWiring& wiring,
                                           const LiveRequest& request);

}  // namespace mdof::tools
