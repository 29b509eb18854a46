// Presets of mdof sensitivity: their options by name, written as TOML and read.
#pragma once

#include <span>
#include <string>
#include <vector>

#include "algo/sensitivity/simulation.h"
#include "schema/base/result.h"

namespace mdof::tools {

// An option of both simulations with one number; `key` ends in its unit. The travel and its bins
// ("travel_mm", "bins") and the seed are separate.
struct PresetNumber {
  const char* key;
  double algo::SimulationOptions::*member;
  const char* help;
};
std::span<const PresetNumber> preset_numbers();

// "simulation-1" or "simulation-2" with the defaults of the paper. Error (usage): unknown name; the
// message names the nearest.
Result<algo::SimulationOptions> preset_defaults(const std::string& name);

// All options except the seed. A stored study keeps this text instead of a plan.
std::string preset_toml(const std::string& name, const algo::SimulationOptions& options);
struct Preset {
  std::string name;
  algo::SimulationOptions options;
};
Result<Preset> parse_preset(const std::string& toml);

}  // namespace mdof::tools
