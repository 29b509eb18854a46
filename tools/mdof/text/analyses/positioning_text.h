// Parameters of ISO 230-2 as tables.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "schema/iso230/positioning.h"

namespace mdof::tools {

struct PositioningColumn {
  std::string name;  // "EYX"; "deviation" for a file.
  bool angle = false;
  Positioning figures;
  // nullopt: the readings are not from a run, or U is unknown.
  std::optional<RunPositioningUncertainty> U = std::nullopt;
};

// A table with a row for each parameter and a column for each element of `columns`. A column whose
// U is known is followed by a column with U.
std::string parameters_text(const std::vector<PositioningColumn>& columns, std::size_t width);
// One row for each target.
std::string targets_text(const PositioningColumn& column, std::size_t width);

}  // namespace mdof::tools
