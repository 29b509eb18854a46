// Reads the settings of the joints that a COMP_FILE corrects from the user's ini file.
#pragma once

#include <string>
#include <vector>

#include "daemon/output/controllers/export.h"
#include "schema/base/result.h"

namespace mdof::tools {

struct JointSettings {
  std::vector<controllers::ExportOptions::Joint> joints;
  // MAX_ACCELERATION and SERVO_PERIOD of each joint that has a section in the ini file. If the file
  // does not set SERVO_PERIOD, it is 1 ms, LinuxCNC's default.
  std::vector<controllers::ExportOptions::Ramp> ramps;
  // A correction that the ini file already has: BACKLASH, which LinuxCNC ignores if the joint has a
  // COMP_FILE, or another COMP_FILE, which the exported file replaces.
  struct Correction {
    char axis;
    bool is_file;
    std::string text;  // "[JOINT_0]BACKLASH = 0.003"
  };
  std::vector<Correction> corrections;
  std::vector<controllers::ExportOptions::Travel> travels;  // HOME and soft limits of each joint
};

// `given`: the joints that the user stated; empty: the joints in the ini file. If the file does not
// state its kinematics, the joints 0, 1, 2 are X, Y, Z. Errors (bad_input; the message names file
// and key): the file cannot be read; LINEAR_UNITS contradicts `inch`; the kinematics contradict
// `given`; the kinematics assign no joints to axes, and `given` is empty; MAX_ACCELERATION or
// SERVO_PERIOD is not above 0; HOME or a limit is not a number.
Result<JointSettings> read_joint_settings(
    const std::string& file, const std::vector<controllers::ExportOptions::Joint>& given,
    bool inch);

}  // namespace mdof::tools
