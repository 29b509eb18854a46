// Presets of mdof sensitivity: their options, which can be written and read as TOML.
#pragma once

#include <span>
#include <string>
#include <vector>

#include "algo/sensitivity/simulation.h"
#include "schema/base/result.h"

namespace mdof::tools {

// An option with one number, which both presets have. `key` ends in the unit. "travel_mm", "bins"
// and the seed are not PresetNumbers.
struct PresetNumber {
  const char* key;
  double algo::SimulationOptions::*member;
  const char* help;
};
std::span<const PresetNumber> preset_numbers();

// The options of "simulation-1" or "simulation-2" with the values of the paper. Error (usage): the
// name is unknown; the message states the most similar name.
Result<algo::SimulationOptions> preset_defaults(const std::string& name);

// Writes all options except the seed as TOML. The database stores this text if a study has a preset
// instead of a plan.
std::string preset_toml(const std::string& name, const algo::SimulationOptions& options);
struct Preset {
  std::string name;
  algo::SimulationOptions options;
};
Result<Preset> parse_preset(const std::string& toml);

}  // namespace mdof::tools
