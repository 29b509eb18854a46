#include "tools/mdof/linuxcnc/joint_settings.h"

#include <algorithm>
#include <optional>

#include "schema/base/number/number.h"
#include "schema/units.h"
#include "tools/mdof/linuxcnc/configuration.h"

namespace mdof::tools {
namespace {

using controllers::ExportOptions;

Result<double> positive_value(const LinuxCncIni& ini, const std::string& section,
                              const std::string& key) {
  const std::string text = ini.value(section, key);
  double x = 0;
  const char* const end = text.data() + text.size();
  if (!text.empty() && parse_double(text.data(), end, x) == end && x > 0) return x;
  return bad_input(ini.file.string() + ": [" + section + "]" + key + " = \"" + text +
                   "\" must be a number above 0");
}

// nullopt: the ini file does not contain the key.
Result<std::optional<double>> position_m(const LinuxCncIni& ini, const std::string& section,
                                         const char* key, double unit_m) {
  const std::string text = ini.value(section, key);
  if (text.empty()) return std::optional<double>();
  double x = 0;
  const char* const end = text.data() + text.size();
  if (parse_double(text.data(), end, x) == end) return std::optional<double>(x * unit_m);
  return bad_input(ini.file.string() + ": [" + section + "]" + key + " = \"" + text +
                   "\" must be a number");
}

// Whether a value is missing or 0.
bool is_zero(const std::string& text) {
  double x = 0;
  const char* const end = text.data() + text.size();
  return text.empty() || (parse_double(text.data(), end, x) == end && x == 0);
}

Status check_unit(const LinuxCncIni& ini, bool inch) {
  const auto is_inch = is_inch_machine(ini);
  if (!is_inch) return in_context(ini.file.string(), is_inch.error());
  if (*is_inch == inch) return {};
  return bad_input(ini.file.string() + ": [TRAJ]LINEAR_UNITS is " +
                   ini.value("TRAJ", "LINEAR_UNITS") + ", but the exported files would be in " +
                   (inch ? "inch" : "mm") + "; give --units " + (*is_inch ? "inch" : "mm"));
}

using Joints = std::vector<ExportOptions::Joint>;

// "Y=1,Y=2": the joints of one axis.
std::string joints_text(const Joints& joints, char axis) {
  std::string text;
  for (const auto& joint : joints)
    if (joint.axis == axis)
      text += (text.empty() ? "" : ",") + std::string(1, axis) + "=" + std::to_string(joint.number);
  return text;
}

Result<Joints> joints_of(const LinuxCncIni& ini, const Joints& given) {
  if (!ini.find("KINS", "KINEMATICS"))
    return given.empty() ? Joints{{'X', 0}, {'Y', 1}, {'Z', 2}} : given;
  const auto by_axis = trivkins_joints(ini);
  if (!by_axis && !given.empty()) return given;
  if (!by_axis)
    return bad_input(
        ini.file.string() + ": " + by_axis.error().message +
        "; if each joint nevertheless moves one axis, give the joint of each axis, for example "
        "--joint X=0");
  Joints joints;
  for (const AxisJoint& joint : *by_axis) joints.push_back({joint.axis, joint.number});
  for (const auto& [axis, number] : given) {
    const std::string right = joints_text(joints, axis);
    if (joints_text(given, axis) != right)
      return bad_input(ini.file.string() +
                       ": [KINS]KINEMATICS = " + ini.value("KINS", "KINEMATICS") +
                       " contradicts --joint " + joints_text(given, axis) + "; " +
                       (right.empty() ? std::string("axis ") + axis + " has no joint"
                                      : "give --joint " + right));
  }
  return given.empty() ? joints : given;
}

}  // namespace

Result<JointSettings> read_joint_settings(const std::string& file, const Joints& given, bool inch) {
  MDOF_TRY(const LinuxCncIni ini, read_linuxcnc_ini(file));
  MDOF_CHECK(check_unit(ini, inch));
  double period_s = ExportOptions::Ramp{}.period_s;
  if (ini.find("EMCMOT", "SERVO_PERIOD")) {
    MDOF_TRY(const double period_ns, positive_value(ini, "EMCMOT", "SERVO_PERIOD"));
    period_s = period_ns * 1e-9;
  }
  const double unit_m = inch ? kInch_m : 1e-3;
  JointSettings settings;
  MDOF_TRY(settings.joints, joints_of(ini, given));
  for (const auto& [axis, number] : settings.joints) {
    const std::string section = "JOINT_" + std::to_string(number);
    const bool there = std::any_of(ini.entries.begin(), ini.entries.end(),
                                   [&](const IniEntry& e) { return e.section == section; });
    if (!there) continue;
    MDOF_TRY(const double most, positive_value(ini, section, "MAX_ACCELERATION"));
    settings.ramps.push_back({axis, most * unit_m, period_s});
    for (const char* key : {"BACKLASH", "COMP_FILE"}) {
      const std::string value = ini.value(section, key);
      if (!is_zero(value))
        settings.corrections.push_back(
            {axis, key == std::string("COMP_FILE"), "[" + section + "]" + key + " = " + value});
    }
    MDOF_TRY(const auto home_m, position_m(ini, section, "HOME", unit_m));
    MDOF_TRY(const auto from_m, position_m(ini, section, "MIN_LIMIT", unit_m));
    MDOF_TRY(const auto to_m, position_m(ini, section, "MAX_LIMIT", unit_m));
    settings.travels.push_back({axis, home_m.value_or(0), from_m, to_m});
  }
  return settings;
}

}  // namespace mdof::tools
