// Parameters of ISO 230-2 as tables for people.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "schema/iso230/positioning.h"

namespace mdof::tools {

struct PositioningColumn {
  std::string name;  // "EYX"; of a file "deviation"
  bool angle = false;
  Positioning figures;
  std::optional<RunPositioningUncertainty> U = std::nullopt;  // of a run
};

// A row a parameter, a column a series, with that of U where it is known.
std::string parameters_text(const std::vector<PositioningColumn>& columns, std::size_t width);
// A row a target.
std::string targets_text(const PositioningColumn& column, std::size_t width);

}  // namespace mdof::tools
