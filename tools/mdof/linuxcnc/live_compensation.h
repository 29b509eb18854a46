// What a configuration of LinuxCNC needs for live compensation: limits that are safe on it, and the
// lines of HAL that put the component between motion and drives.
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
  bool second = false;  // of an axis with two joints, as of a gantry
};

// In machine units, s.
struct LiveCompensation {
  bool inch = false;
  std::vector<LiveJoint> joints;
  double max_offset = 0, max_velocity = 0, max_acceleration = 0, fade_velocity = 0;
  std::string offset_reason, velocity_reason;  // what they follow from
  std::string hal;                             // of kCompensationHal
};

struct LiveRequest {
  double margin_mm = 0.1;  // between soft limits and stops
  std::string socket;
  bool simulated = false, despite_warnings = false;
  bool one_approach = false;  // a table of one approach holds in both
};

// Errors: bad_input with all that cannot be safe, each by its section and key.
Result<LiveCompensation> live_compensation(const LinuxCncIni& ini, const HalWiring& wiring,
                                           const LiveRequest& request);

}  // namespace mdof::tools
