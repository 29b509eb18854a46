// Loads PART.toml and the files that it names: the path, the machine, and the errors (causes) of
// each layer.
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "algo/part/part_error.h"
#include "schema/base/result.h"
#include "schema/machine/machine.h"
#include "schema/notice/notice.h"
#include "schema/part/part_plan.h"

namespace mdof::tools {

struct LoadedLayer {
  PartLayer plan;
  std::string compensated_by;  // The compensation that corrects this layer; empty: none.
};

struct LoadedPart {
  PartPlan plan;
  Machine machine;
  algo::PartPath path;
  std::vector<LoadedLayer> layers;  // Active layers only.
  std::vector<algo::PartCause> causes;
  // The errors in `causes` that remain after the compensation of each layer.
  std::vector<algo::PartCause> left;
  std::vector<std::string> not_measured, no_u;
  // Facts that the result depends on:
  // - tables that do not cover the whole path
  // - tables ("table:N") without a slope, so that squareness is not included
  // - the number of points of the path that the form map does not cover
  std::vector<std::string> beyond_tables, tables_without_slope;
  std::size_t points_off_form_map = 0;
  // See algo::MachineCauses.
  std::vector<std::pair<std::string, std::size_t>> unknown_approach;
  Notices notices;  // Notices on missing data; the subject of a notice is the layer.
};

// File paths are relative to PART.toml. `database` contains the stored tables. Also prints warnings
// for the facts above.
Result<LoadedPart> load_part(const std::string& file, const std::string& database);

}  // namespace mdof::tools
