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
  std::optional<RunPositioningUncertainty> U = std::nullopt;  // For a run only.
};

// One row for each parameter, one column for each series, and a column for U where it is known.
std::string parameters_text(const std::vector<PositioningColumn>& columns, std::size_t width);
// One row for each target.
std::string targets_text(const PositioningColumn& column, std::size_t width);

}  // namespace mdof::tools
