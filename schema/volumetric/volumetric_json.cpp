#include "schema/volumetric/volumetric_json.h"

#include <cmath>

#include "schema/run_json.h"
#include "schema/sample.h"
#include "schema/units.h"

namespace mdof {
namespace {

// The first word is part of the interface: tools/linuxcnc loads only tables with this word.
constexpr const char* kSense =
    "correction: added to the commands of X, Y and Z, so that the tool reaches the commanded "
    "position";
constexpr const char* kAxesMm[] = {"X_mm", "Y_mm", "Z_mm"};
constexpr const char* kAxesUm[] = {"X_um", "Y_um", "Z_um"};
constexpr const char* kRotaryKeys[] = {"A_deg", "B_deg", "C_deg"};

void write_commands(JsonWriter& json, const VolumetricTable& t) {
  json.key("command_mm").begin_object();
  for (std::size_t k = 0; k < 3; ++k) {
    json.key(std::string(1, kAxesMm[k][0])).begin_array();
    for (const double x : t.command_m[k]) json.value(to_mm(x));
    json.end_array();
  }
  json.end_object();
  write_rotary(json, t);
}

// The largest additional u in the middle between the nodes of all axes; NaN: unknown.
Vec3 largest_u_between(const VolumetricTable& t) {
  Vec3 u{};
  for (std::size_t k = 0; k < 3; ++k)
    for (const auto& axis : t.u_between_m) {
      double largest = axis.empty() ? 0 : kNaN;
      for (const Vec3& cell : axis) largest = std::fmax(largest, cell[k]);
      u[k] = std::hypot(u[k], largest);
    }
  return t.has_u_between() ? u : Vec3{kNaN, kNaN, kNaN};
}

}  // namespace

void write_rotary(JsonWriter& json, const VolumetricTable& t) {
  json.key("rotary").begin_object();
  for (std::size_t k = 0; k < 3; ++k)
    if (t.machine.find(kRotaryKeys[k][0])) json.field(kRotaryKeys[k], to_deg(t.rotary_rad[k]));
  json.end_object();
}

void write_um(JsonWriter& json, const char* key, const Vec3& value_m) {
  json.key(key).begin_object();
  // + 0.0 converts -0 to 0.
  for (std::size_t k = 0; k < 3; ++k) json.field(kAxesUm[k], to_um(value_m[k]) + 0.0);
  json.end_object();
}

void write_volumetric_members(JsonWriter& json, const VolumetricTable& t) {
  json.field("table", t.id).field("axis", "volume").field("machine", t.name);
  json.field("chain", t.machine.text).field("chain_travel", chain_travels_text(t.machine));
  json.key("runs").begin_array();
  for (const std::int64_t run : t.runs) json.value(run);
  json.end_array().field("approach", t.approach).key("tool_point_mm").begin_array();
  for (const double x : t.tool_m) json.value(to_mm(x));
  json.end_array();
  write_commands(json, t);
  json.field("nodes", static_cast<std::uint64_t>(t.nodes())).field("sense", kSense);
  write_um(json, "interpolation", t.interpolation_m);
  write_um(json, "u_interpolation", largest_u_between(t));
  write_um(json, "reversal_left", t.reversal_m);
  json.field("place_left_um", to_um(t.place_left_m))
      .field("turn_left_urad", to_urad(t.turn_left_rad));
  write_strings(json, "not_measured", t.not_measured);
  json.field("u_covers", covers_text(t));
  write_strings(json, "not_declared", t.u_not_declared);
  write_strings(json, "beyond_tables", t.beyond_tables);
  json.field("noise_only", t.noise_only == NoiseOnly::all)
      .field("simulated", t.simulated)
      .field("created_utc", t.created_utc)
      .field("sha256", t.sha256);
}

void write_volumetric_node(JsonWriter& json, const VolumetricTable& t, std::size_t node,
                           bool with_parts) {
  const auto add_um = [&](const Vec3& values) {
    for (const double x : values) json.value(to_um(x) + 0.0);  // + 0.0 converts -0 to 0
  };
  json.begin_array();
  for (const double x : t.command_at(node)) json.value(to_mm(x));
  add_um(t.correction_m[node]);
  add_um(t.u_m[node]);
  if (with_parts) {
    add_um(t.u_common_at(node));
    add_um(t.u_independent_at(node));
  }
  json.end_array();
}

}  // namespace mdof
