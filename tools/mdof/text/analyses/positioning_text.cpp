#include "tools/mdof/text/analyses/positioning_text.h"

#include "tools/mdof/text/text_table.h"

namespace mdof::tools {
namespace {

struct Parameter {
  const char* name;
  double Positioning::*value;
};
constexpr Parameter kParameters[] = {
    {"B", &Positioning::B},
    {"B mean", &Positioning::B_mean},
    {"R forward", &Positioning::R_forward},
    {"R reverse", &Positioning::R_reverse},
    {"R", &Positioning::R},
    {"E forward", &Positioning::E_forward},
    {"E reverse", &Positioning::E_reverse},
    {"E", &Positioning::E},
    {"M", &Positioning::M},
    {"A forward", &Positioning::A_forward},
    {"A reverse", &Positioning::A_reverse},
    {"A", &Positioning::A},
};

std::string unit_of(const PositioningColumn& column) {
  return column.angle ? "/µrad" : "/µm";
}

std::string shown(const PositioningColumn& column, double value) {
  return column.angle ? in_urad(value) : in_um(value);
}

}  // namespace

std::string parameters_text(const std::vector<PositioningColumn>& columns) {
  std::vector<std::string> head{"ISO 230-2"};
  for (const auto& column : columns) head.push_back(column.name + unit_of(column));
  TextTable table(std::move(head));
  for (const Parameter& parameter : kParameters) {
    std::vector<std::string> row{parameter.name};
    for (const auto& column : columns)
      row.push_back(shown(column, column.figures.*parameter.value));
    table.add(std::move(row));
  }
  return table.text();
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
