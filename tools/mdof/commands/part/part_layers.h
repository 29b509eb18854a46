// PART.toml with all that it names: the path, the machine, and the causes of each layer.
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
  std::string compensated_by;  // what takes it out; empty: nothing does
};

struct LoadedPart {
  PartPlan plan;
  Machine machine;
  algo::PartPath path;
  std::vector<LoadedLayer> layers;  // those that are on
  std::vector<algo::PartCause> causes;
  // The same causes when each layer's compensation is applied: what is left of them.
  std::vector<algo::PartCause> left;
  std::vector<std::string> not_measured, no_u;
  // What was assumed: tables beyond whose ends the path goes, tables ("table:N") whose removed
  // slope would be squareness, points of the path that the form map does not cover.
  std::vector<std::string> beyond_tables, tables_without_slope;
  std::size_t points_off_form_map = 0;
  Notices notices;  // what a layer lacks; its subject is the layer
};

// Files stand relative to PART.toml; stored tables in the database. What was assumed is also
// printed as a warning.
Result<LoadedPart> load_part(const std::string& file, const std::string& database);

}  // namespace mdof::tools
