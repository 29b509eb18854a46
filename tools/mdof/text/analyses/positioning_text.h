// Parameters of ISO 230-2 as tables for people.
#pragma once

#include <string>
#include <vector>

#include "schema/iso230/positioning.h"

namespace mdof::tools {

struct PositioningColumn {
  std::string name;  // "EYX"; of a file "deviation"
  bool angle = false;
  Positioning figures;
};

// A row a parameter, a column a series.
std::string parameters_text(const std::vector<PositioningColumn>& columns);
// A row a target.
std::string targets_text(const PositioningColumn& column, std::size_t width);

}  // namespace mdof::tools
