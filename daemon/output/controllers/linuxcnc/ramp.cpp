#include "daemon/output/controllers/linuxcnc/ramp.h"

#include <algorithm>
#include <cmath>
#include <string>

#include "schema/base/number/number_text.h"
#include "schema/units.h"

namespace mdof::controllers {
namespace {

constexpr double kLinuxCncPeriod_s = 1e-3;  // LinuxCNC's default SERVO_PERIOD
constexpr double kNoReversal_m = 1e-12;
constexpr const char* kRampRemedy =
    "; change MAX_ACCELERATION, or use the live compensation, which does not have this limitation";

std::string mm_s2(double m_s2) {
  return plain_number(to_mm(m_s2), 4) + " mm/s^2";
}

std::string um_text(double m) {
  return plain_number(to_um(m), 4) + " um";
}

double reversal_at(const Series& s, std::size_t i) {
  return std::abs(s.forward[i] - s.reverse[i]);
}

void note_ramp(const Series& s, const ExportOptions::Ramp& ramp, Export& out) {
  const UnappliedSteps held = unapplied_steps(ramp);
  std::size_t worst = s.position_m.size();
  for (std::size_t i = 0; i < s.position_m.size(); ++i)
    if (held.holds(reversal_at(s, i)) &&
        (worst == s.position_m.size() || reversal_at(s, i) > reversal_at(s, worst)))
      worst = i;
  if (worst == s.position_m.size()) return;
  out.notes.push_back(
      s.error + ": LinuxCNC does not apply the reversal of " + um_text(reversal_at(s, worst)) +
      " at " + plain_number(to_mm(s.position_m[worst]), 9) + " mm. With MAX_ACCELERATION " +
      mm_s2(ramp.max_acceleration_m_s2) + " and a servo period of " +
      plain_number(ramp.period_s * 1e3, 4) + " ms, it starts no motion for a reversal above " +
      um_text(held.above_m) + " and up to " + um_text(held.up_to_m) + kRampRemedy);
}

// Adds a note on values of MAX_ACCELERATION for which a step is not applied. These values are
// proportional to the step.
void note_unknown_ramp(const Series& s, Export& out) {
  double least = INFINITY, most = 0;
  for (std::size_t i = 0; i < s.position_m.size(); ++i) {
    const double reversal = reversal_at(s, i);
    if (!(reversal > kNoReversal_m)) continue;
    least = std::min(least, reversal);
    most = std::max(most, reversal);
  }
  if (!(most > 0)) return;
  // The largest step that is not applied if MAX_ACCELERATION is 1 m/s².
  const double up_to_m = unapplied_steps({s.along, 1.0, kLinuxCncPeriod_s}).up_to_m;
  out.notes.push_back(
      s.error + ": MAX_ACCELERATION of the joint is unknown. The reversals are from " +
      um_text(least) + " to " + um_text(most) + ". If MAX_ACCELERATION is from " +
      mm_s2(least / up_to_m) + " to " + mm_s2(2 * most / up_to_m) +
      " (servo period 1 ms), LinuxCNC does not apply the reversal at some positions, because it "
      "starts no motion for a step of this size; give MAX_ACCELERATION (option "
      "max-acceleration-mm-s2) or the ini file (option ini)");
}

}  // namespace

UnappliedSteps unapplied_steps(const ExportOptions::Ramp& ramp) {
  const double whole = 0.5 * ramp.max_acceleration_m_s2 * ramp.period_s * ramp.period_s;
  return {0.5 * whole, whole};
}

void note_unapplied_reversals(const Series& series, const ExportOptions& options, Export& out) {
  bool known = false;
  for (const ExportOptions::Ramp& ramp : options.ramps) {
    if (ramp.axis != series.along) continue;
    known = true;
    note_ramp(series, ramp, out);
  }
  if (!known) note_unknown_ramp(series, out);
}

}  // namespace mdof::controllers
