// PART.toml: what a part's errors are predicted from (README.md of algo/part has the layers).
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "schema/base/result.h"

namespace mdof {

struct PartLayer {
  std::string name;               // "axes", "budget", "form", "milling"
  std::vector<std::string> from;  // files or "table:N"; empty: what the machine describes itself
  bool on = true;
  bool compensated = false;   // what its compensation leaves
  std::optional<double> u_m;  // of the form layer: standard uncertainty of its map
};

struct PartPlan {
  std::string name, machine, path;
  std::vector<PartLayer> layers;  // in the order above
};

// The number of "table:12".
std::optional<std::int64_t> table_number(std::string_view from);

// Errors name file, line, key and remedy.
Result<PartPlan> parse_part_plan(std::string_view text, const std::string& source);

}  // namespace mdof
