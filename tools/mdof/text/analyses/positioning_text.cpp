#include "tools/mdof/text/analyses/positioning_text.h"

#include <cmath>

#include "tools/mdof/text/text_table.h"

namespace mdof::tools {
namespace {

using Uncertainty = RunPositioningUncertainty;

struct Parameter {
  const char* name;
  double Positioning::*value;
  double Uncertainty::*U = nullptr;
};
constexpr Parameter kParameters[] = {
    {"B", &Positioning::B, &Uncertainty::B},
    {"B mean", &Positioning::B_mean, &Uncertainty::B_mean},
    {"R forward", &Positioning::R_forward, &Uncertainty::R_forward},
    {"R reverse", &Positioning::R_reverse, &Uncertainty::R_reverse},
    {"R", &Positioning::R, &Uncertainty::R},
    {"E forward", &Positioning::E_forward, &Uncertainty::E_forward},
    {"E reverse", &Positioning::E_reverse, &Uncertainty::E_reverse},
    {"E", &Positioning::E, &Uncertainty::E},
    {"M", &Positioning::M, &Uncertainty::M},
    {"A forward", &Positioning::A_forward},
    {"A reverse", &Positioning::A_reverse},
    {"A", &Positioning::A},
};

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
  for (const Parameter& parameter : kParameters) {
    std::vector<std::string> row{parameter.name};
    for (const auto& column : columns) {
      const double U = column.U && parameter.U != nullptr ? (*column.U).*parameter.U : kNoFigure;
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
