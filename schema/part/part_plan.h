// The file PART.toml: the inputs for the predicted errors of a part. README.md of algo/part
// describes the layers.
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
  std::vector<std::string> from;  // files or "table:N"; empty: the data in the machine file
  bool on = true;
  bool compensated = false;   // the layer contains the errors that remain after compensation
  std::optional<double> u_m;  // form layer only: standard uncertainty of its height map
};

struct PartPlan {
  std::string name, machine, path;
  std::vector<PartLayer> layers;  // in the order above
};

// Returns 12 for "table:12"; nullopt: another text.
std::optional<std::int64_t> table_number(std::string_view from);

// Errors name file, line, key and remedy.
Result<PartPlan> parse_part_plan(std::string_view text, const std::string& source);

}  // namespace mdof
