#include "schema/rig/scan.h"

#include <cmath>

#include "schema/base/number/number_text.h"
#include "schema/rig/rig_tables.h"
#include "schema/units.h"

namespace mdof {
namespace {

constexpr double kMostCentre_mm = 10e3;

}  // namespace

std::optional<RigScan> read_scan(TomlTable& rig, Axis axis) {
  auto table = rig.table("scan");
  if (!table) return std::nullopt;
  RigScan scan;
  scan.probe = table->string("probe");
  scan.angle = table->string("angle", "angle_deg");
  scan.position_m = read_point(*table, "position_mm");
  const double centre_mm = table->number("centre_mm");
  if (!(std::abs(centre_mm) <= kMostCentre_mm))
    table->reject("centre_mm",
                  "must be a position of the encoder in mm, from -10000 to 10000, not " +
                      plain_number(centre_mm));
  scan.centre_m = from_mm(centre_mm);
  const std::string word = table->string("measures");
  const auto along = word.size() == 2 ? axis_from(word.substr(1)) : std::nullopt;
  if (along && (word[0] == '+' || word[0] == '-') && *along != axis)
    scan.direction[static_cast<std::size_t>(*along)] = word[0] == '-' ? -1.0 : 1.0;
  else
    table->reject(
        "measures",
        "\"" + word +
            "\" is not a direction perpendicular to the axis; give a direction such as \"+" +
            (axis == Axis::z ? "X" : "Z") + "\"");
  const std::string sense = table->string("sense", "+");
  if (sense != "+" && sense != "-")
    table->reject("sense", "\"" + sense + "\" must be \"+\" or \"-\"");
  scan.sense = sense == "-" ? -1 : 1;
  scan.delay_s = read_delay_s(*table,
                              "readings of the probe relative to the angle and the encoder, for "
                              "example because of a filter");
  return scan;
}

Result<std::optional<RigScan>> scan_of_rig(std::string_view rig_text, Axis axis,
                                           const std::string& source) {
  MDOF_TRY(auto table, TomlTable::parse(rig_text, source));
  return read_scan(table, axis);
}

}  // namespace mdof
