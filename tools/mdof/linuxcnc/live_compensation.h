// Live compensation for a given configuration of LinuxCNC: safe limits, and the HAL lines that
// connect the component between motion and drives.
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

// In machine units and s.
struct LiveCompensation {
  bool inch = false;
  std::vector<LiveJoint> joints;
  double max_offset = 0, max_velocity = 0, max_acceleration = 0, fade_velocity = 0;
  std::string offset_reason, velocity_reason;  // How each limit was derived.
  std::string hal;                             // Content of the file kCompensationHal.
};

struct LiveRequest {
  double margin_mm = 0.1;  // Distance between soft limits and hard stops.
  std::string socket;
  bool simulated = false, despite_warnings = false;
  bool one_approach = false;  // The tables have one approach, which is applied in both directions.
};

// Error (bad_input): lists every unsafe setting by its section and key.
Result<LiveCompensation> live_compensation(const LinuxCncIni& ini, const HalWiring& wiring,
                                           const LiveRequest& request);

}  // namespace mdof::tools
