// PART.toml with everything that it names: the path, the machine, and the causes of each layer.
#pragma once

#include <string>
#include <vector>

#include "algo/part/part_error.h"
#include "schema/base/result.h"
#include "schema/machine/machine.h"
#include "schema/notice/notice.h"
#include "schema/part/part_plan.h"

namespace mdof::tools {

struct LoadedLayer {
  PartLayer plan;
  std::string compensated_by;  // The compensation that removes it; empty: none.
};

struct LoadedPart {
  PartPlan plan;
  Machine machine;
  algo::PartPath path;
  std::vector<LoadedLayer> layers;  // Active layers only.
  std::vector<algo::PartCause> causes;
  // The remainder of the same causes after the compensation of each layer.
  std::vector<algo::PartCause> left;
  std::vector<std::string> not_measured, no_u;
  // Assumptions: tables that do not cover the path, tables ("table:N") without the slope that would
  // be squareness, points of the path that the form map does not cover.
  std::vector<std::string> beyond_tables, tables_without_slope;
  std::size_t points_off_form_map = 0;
  Notices notices;  // Missing data of a layer; the subject is the layer.
};

// File paths are relative to PART.toml; stored tables are in the database. Assumptions are also
// printed as warnings.
Result<LoadedPart> load_part(const std::string& file, const std::string& database);

}  // namespace mdof::tools
