#include "tools/mdof/text/analyses/mounting_text.h"

#include <cmath>

#include "schema/base/json_writer.h"
#include "schema/base/number/number_text.h"
#include "schema/uncertainty/covers.h"
#include "schema/units.h"
#include "tools/mdof/text/run_tables.h"
#include "tools/mdof/text/text_table.h"

namespace mdof::tools {
namespace {

void write_vector(JsonWriter& json, const char* key, const Vec3& v, double factor) {
  json.key(key).begin_array();
  for (const double x : v) json.value(x * factor);
  json.end_array();
}

std::string place(const MountedProbe& probe, std::size_t axis) {
  const double u_m = probe.u_position_m[axis];
  const double at_mm = to_mm(probe.position_m[axis]);
  return u_m == 0 ? fixed(at_mm, 4) : with_u(at_mm, to_mm(u_m), 4);
}

// The angle between the calibrated direction of the probe and its direction in the rig, with u, in
// mrad.
std::string turn(const MountedProbe& probe, const Probe& nominal) {
  if (!probe.direction_seen) return "as in the rig";
  double squared = 0;
  for (std::size_t k = 0; k < 3; ++k)
    squared += std::pow(probe.direction[k] - nominal.direction[k], 2);
  return with_u(std::sqrt(squared) * 1e3, probe.u_direction_rad * 1e3, 2);
}

}  // namespace

std::string mounting_text(const MountingCalibration& found, const Rig& rig, std::size_t width) {
  TextTable table({"probe", "x/mm", "y/mm", "z/mm", "turned/mrad", "zero/um"});
  for (std::size_t k = 0; k < found.probes.size(); ++k) {
    const MountedProbe& p = found.probes[k];
    table.add({p.id, place(p, 0), place(p, 1), place(p, 2), turn(p, rig.probes[k]),
               p.zero_seen ? with_u(to_um(p.zero_m), to_um(p.u_zero_m), 3) : "as in the rig"});
  }
  std::string text = noise_only_notice(!rig.declares_uncertainty()) + table.text(width);
  text += "\n" + std::to_string(found.clampings) + " clampings, whose tilts differ by up to " +
          plain_number(found.tilt_rad * 1e3, 3) + " mrad, " + std::to_string(found.readings) +
          " readings\nchi-square " + plain_number(found.chi_square, 4) + " with " +
          std::to_string(found.freedom) + " degrees of freedom" +
          (found.explained ? ""
                           : "; chi-square is larger than expected from the noise, so u was "
                             "increased") +
          "\n";
  if (!found.not_seen.empty()) text += "Not determined:\n";
  for (const auto& what : found.not_seen) text += "- " + wrapped(what, width - 2, 2) + "\n";
  return text +
         wrapped(
             "\u00b1 is the standard uncertainty u. It does not contain a common shift of all "
             "probes of a plane.",
             width) +
         "\n";
}

std::string mounting_json(const MountingCalibration& found, const CalibrationRecord& record,
                          const std::string& file, bool rig_declares) {
  JsonWriter json;
  json.begin_object().field("kind", "mounting").field("rig", record.rig);
  json.field("date", record.date).field("valid_until", record.valid_until).key("record");
  file.empty() ? json.null() : json.value(file);
  json.key("probes").begin_array();
  for (const MountedProbe& p : found.probes) {
    json.begin_object().field("id", p.id);
    write_vector(json, "position_mm", p.position_m, 1e3);
    write_vector(json, "u_position_mm", p.u_position_m, 1e3);
    json.field("position_seen", p.position_seen);
    write_vector(json, "direction", p.direction, 1);
    json.field("u_direction_mrad", p.u_direction_rad * 1e3);
    json.field("direction_seen", p.direction_seen).field("zero_um", to_um(p.zero_m));
    json.field("u_zero_um", to_um(p.u_zero_m)).field("zero_seen", p.zero_seen);
    json.field("sensitivity_ppm", p.scale_1 * 1e6).field("u_sensitivity_ppm", p.u_scale_1 * 1e6);
    json.field("readings", static_cast<std::uint64_t>(p.readings)).end_object();
  }
  json.end_array();
  write_vector(json, "u_together_mm", found.u_together_m, 1e3);
  json.key("not_seen").begin_array();
  for (const auto& what : found.not_seen) json.value(what);
  json.end_array().field("clampings", static_cast<std::uint64_t>(found.clampings));
  json.field("readings", static_cast<std::uint64_t>(found.readings));
  json.field("tilt_mrad", found.tilt_rad * 1e3).field("chi_square", found.chi_square);
  json.field("freedom", found.freedom).field("explained", found.explained);
  json.field("u_covers",
             covers_text(Covers{rig_declares ? Covered::noise_declared : Covered::noise_only}))
      .field("noise_only", !rig_declares)
      .end_object();
  return json.take();
}

}  // namespace mdof::tools
