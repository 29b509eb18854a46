#include "tools/mdof/linuxcnc/joint_ramps.h"

#include <algorithm>

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

Status check_unit(const LinuxCncIni& ini, bool inch) {
  const auto is_inch = is_inch_machine(ini);
  if (!is_inch) return in_context(ini.file.string(), is_inch.error());
  if (*is_inch == inch) return {};
  return bad_input(ini.file.string() + ": [TRAJ]LINEAR_UNITS is " +
                   ini.value("TRAJ", "LINEAR_UNITS") + ", but the exported files would be in " +
                   (inch ? "inch" : "mm") + "; give --units " + (*is_inch ? "inch" : "mm"));
}

}  // namespace

Result<std::vector<ExportOptions::Ramp>> read_joint_ramps(
    const std::string& file, const std::vector<ExportOptions::Joint>& joints, bool inch) {
  MDOF_TRY(const LinuxCncIni ini, read_linuxcnc_ini(file));
  MDOF_CHECK(check_unit(ini, inch));
  double period_s = ExportOptions::Ramp{}.period_s;
  if (ini.find("EMCMOT", "SERVO_PERIOD")) {
    MDOF_TRY(const double period_ns, positive_value(ini, "EMCMOT", "SERVO_PERIOD"));
    period_s = period_ns * 1e-9;
  }
  std::vector<ExportOptions::Ramp> ramps;
  for (const auto& [axis, number] :
       joints.empty() ? std::vector<ExportOptions::Joint>{{'X', 0}, {'Y', 1}, {'Z', 2}} : joints) {
    const std::string section = "JOINT_" + std::to_string(number);
    const bool there = std::any_of(ini.entries.begin(), ini.entries.end(),
                                   [&](const IniEntry& e) { return e.section == section; });
    if (!there) continue;
    MDOF_TRY(const double most, positive_value(ini, section, "MAX_ACCELERATION"));
    ramps.push_back({axis, most * (inch ? kInch_m : 1e-3), period_s});
  }
  return ramps;
}

}  // namespace mdof::tools
