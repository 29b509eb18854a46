#include "tools/mdof/text/analyses/positioning_text.h"

#include <algorithm>
#include <cmath>

#include "tools/mdof/text/text_table.h"

namespace mdof::tools {
namespace {

// "R_forward" as "R forward".
std::string shown_name(std::string name) {
  std::replace(name.begin(), name.end(), '_', ' ');
  return name;
}

std::string unit_of(const PositioningColumn& column) {
  return column.angle ? "/µrad" : "/µm";
}

std::string shown(const PositioningColumn& column, double value, double U = kNoFigure) {
  return column.angle ? urad_to_place(value, U) : um_to_place(value, U);
}

}  // namespace

std::string parameters_text(const std::vector<PositioningColumn>& columns, std::size_t width) {
  std::vector<std::string> head{"ISO 230-2"};
  for (const auto& column : columns) {
    head.push_back(column.name + unit_of(column));
    if (column.U) head.emplace_back("U");
  }
  TextTable table(std::move(head));
  for (const PositioningParameter& parameter : kPositioningParameters) {
    std::vector<std::string> row{shown_name(parameter.name)};
    for (const auto& column : columns) {
      const double U = column.U ? (*column.U).*parameter.U : kNoFigure;
      row.push_back(shown(column, column.figures.*parameter.value, U));
      if (column.U) row.push_back(std::isfinite(U) ? shown(column, U, U) : "");
    }
    table.add(std::move(row));
  }
  return table.text(width);
}

std::string targets_text(const PositioningColumn& column, std::size_t width) {
  const std::string unit = unit_of(column);
  TextTable table({"target/mm", "n +", "n -", "mean +" + unit, "mean -" + unit, "B" + unit,
                   "s +" + unit, "s -" + unit, "R" + unit});
  for (const PositioningTarget& t : column.figures.targets) {
    table.add({in_mm(t.target_m), std::to_string(t.forward.n), std::to_string(t.reverse.n),
               shown(column, t.forward.mean), shown(column, t.reverse.mean), shown(column, t.B),
               shown(column, t.forward.s), shown(column, t.reverse.s), shown(column, t.R)});
  }
  return table.text(width);
}

}  // namespace mdof::tools
