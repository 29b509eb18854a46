#include "tools/mdof/study/preset.h"

#include <array>

#include "schema/base/json_writer.h"
#include "schema/base/toml/toml_reader.h"

namespace mdof::tools {
namespace {

using Options = algo::SimulationOptions;

constexpr std::array kNumbers = {
    PresetNumber{"angle_range_urad", &Options::angle_range_urad,
                 "Limit (±) of the true roll, pitch and yaw (uniform distribution)"},
    PresetNumber{"offset_range_um", &Options::offset_range_um,
                 "Limit (±) of the true straightness errors (uniform distribution)"},
    PresetNumber{"l_mm", &Options::l_mm, "Distance l of the probes A, B, C and E from the origin"},
    PresetNumber{"side_plane_mm", &Options::side_plane_mm,
                 "Coordinate y of the side target surface"},
    PresetNumber{"side_height_mm", &Options::side_height_mm, "Height l'' of the probes D and E"},
    PresetNumber{"radius_um", &Options::radius_um, "Radius r by which each probe is displaced"},
    PresetNumber{"theta_y_mrad", &Options::theta_y_mrad, "Rotation of the top unit about Z"},
    PresetNumber{"theta_p_mrad", &Options::theta_p_mrad, "Rotation of the side unit about Y"},
    PresetNumber{"theta_r_mrad", &Options::theta_r_mrad, "Rotation of both probe units about X"},
    PresetNumber{"sigma_x_um", &Options::sigma_x_um, "Displacement of both probe units along X"},
    PresetNumber{"sigma_y_um", &Options::sigma_y_um, "Displacement of the top unit along Y"},
    PresetNumber{"sigma_z_um", &Options::sigma_z_um, "Displacement of the side unit along Z"},
};

// The shortest text that a program reads as exactly this double.
std::string shortest(double x) {
  JsonWriter number;
  number.value(x);
  return number.take();
}

}  // namespace

std::span<const PresetNumber> preset_numbers() {
  return kNumbers;
}

Result<Options> preset_defaults(const std::string& name) {
  if (name == "simulation-1") return algo::simulation_1_defaults();
  if (name == "simulation-2") return algo::simulation_2_defaults();
  const std::string nearest = nearest_candidate(name, {"simulation-1", "simulation-2"});
  return fail(ErrorCode::usage,
              "--preset: \"" + name + "\" is not a preset" +
                  (nearest.empty() ? "" : " (did you mean \"" + nearest + "\"?)") +
                  "; the presets are simulation-1 and simulation-2");
}

std::string preset_toml(const std::string& name, const Options& options) {
  std::string toml = "preset = \"" + name + "\"\n";
  for (const PresetNumber& number : kNumbers)
    toml += std::string(number.key) + " = " + shortest(options.*number.member) + "\n";
  toml += "travel_mm = [" + shortest(options.travel_from_mm) + ", " +
          shortest(options.travel_to_mm) + "]\n";
  return toml + "bins = " + std::to_string(options.travel_bins) + "\n";
}

Result<Preset> parse_preset(const std::string& toml) {
  MDOF_TRY(TomlTable table, TomlTable::parse(toml, "preset"));
  Preset preset;
  preset.name = table.string("preset");
  MDOF_TRY(preset.options, preset_defaults(preset.name));
  for (const PresetNumber& number : kNumbers)
    preset.options.*number.member = table.number(number.key);
  const auto travel = table.numbers("travel_mm");
  if (travel.size() != 2) table.reject("travel_mm", "must be [from, to]");
  const std::int64_t bins = table.integer("bins");
  if (bins < 1) table.reject("bins", "must be 1 or more");
  MDOF_CHECK(table.finish());
  preset.options.travel_from_mm = travel[0];
  preset.options.travel_to_mm = travel[1];
  preset.options.travel_bins = static_cast<std::size_t>(bins);
  return preset;
}

}  // namespace mdof::tools
