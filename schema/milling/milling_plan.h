// The content of PLAN.toml for mdof milling: a micro end mill, its run-out, the cut and the force
// coefficients, in SI units.
#pragma once

#include <array>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "schema/base/result.h"

namespace mdof {

enum class ChipModel { sine, eq8, trochoid };
enum class DeflectionModel { rigid, paper, steady };

// A cylinder of the beam model of the tool. The cylinders are in the order from the holder to the
// tip.
struct ToolSection {
  double length_m = 0, diameter_m = 0;
};

struct MillingPlan {
  std::string name;
  std::string force_source;  // source of the coefficients; empty: not stated
  // [tool]
  double diameter_m = 0;
  int teeth = 0;
  double helix_rad = 0;
  std::vector<ToolSection> sections;
  // Factors on all lengths and all diameters of `sections`, to vary them.
  double overhang_factor = 1, beam_diameter_factor = 1;
  double youngs_modulus_Pa = 0;
  // [runout] Run-out at the tip: magnitude and angle. runout_tilt: change of the run-out, m per m
  // of height.
  double runout_m = 0, runout_angle_rad = 0, runout_tilt = 0;
  // [cut]
  bool is_up = true;
  double spindle_hz = 0, feed_per_tooth_m = 0, radial_depth_m = 0, axial_depth_m = 0;
  // [force]: per area of the chip, N/m²; per length of the edge, N/m
  double Kt = 0, Kr = 0, Kte = 0, Kre = 0;
  // [model]
  ChipModel chip = ChipModel::eq8;
  DeflectionModel deflection = DeflectionModel::steady;
  int elements = 10, steps_per_turn = 3600;
  double wall_grid_m = 0.05e-6;

  double radius_m() const { return diameter_m / 2; }
  double overhang_m() const;
  std::vector<ToolSection> beam() const;  // `sections` with the factors
};

// A number of PLAN.toml that can have a standard uncertainty. The key of the uncertainty is "u_" +
// key. The factors of the beam have only this key; it is in percent of the value.
struct MillingInput {
  const char* table;
  const char* key;  // including the unit
  double MillingPlan::*member;
  double unit;  // factor that converts the number in PLAN.toml to SI
  std::string name() const { return std::string(table) + "." + key; }
};
const std::vector<MillingInput>& milling_inputs();

struct DeclaredMillingPlan {
  MillingPlan plan;
  std::vector<std::pair<const MillingInput*, double>> u;  // declared u, SI
};

// Errors state file, line, key and limit. An unknown key is an error.
Result<DeclaredMillingPlan> parse_milling_plan(std::string_view text, const std::string& source);

// Returns the tool and the cut of Huo et al. (2017) as text of PLAN.toml. Comments in the text mark
// values that the paper does not state.
std::string_view micro_end_mill_preset();

const char* to_string(ChipModel model);
const char* to_string(DeflectionModel model);

}  // namespace mdof
