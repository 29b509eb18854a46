#include "tools/mdof/csv/table_csv.h"

#include <cmath>
#include <string>
#include <vector>

#include "schema/imported/series.h"
#include "schema/iso230/positioning.h"
#include "schema/recording/probe_log.h"
#include "schema/units.h"
#include "tools/mdof/csv/csv_text.h"
#include "tools/mdof/text/text_table.h"

namespace mdof::tools {

namespace {

double combined(double u_random, const std::vector<double>& declared, std::size_t row) {
  return declared.empty() ? u_random : std::hypot(u_random, declared[row]);
}

// The columns of one kind of value: one for each error, and one for the positioning error if the
// table contains it.
struct Columns {
  std::string prefix;
  const std::array<std::vector<double>, 5>& errors;
  const std::vector<double>& along;
  bool combine = false;  // the values are u from noise; combine them with the declared u
};

double cell_of(const CompensationTable& t, const Columns& columns, std::size_t k, std::size_t row) {
  const double value = columns.errors[k][row];
  return columns.combine ? combined(value, t.u_declared[k], row) : value;
}

double cell_along(const CompensationTable& t, const Columns& columns, std::size_t row) {
  if (columns.along.empty()) return kNoFigure;
  return columns.combine ? t.positioning_u_at(&columns.along == &t.positioning.u_forward, row)
                         : columns.along[row];
}

}  // namespace

std::string table_csv(const CompensationTable& t) {
  const PositioningErrors& along = t.positioning;
  std::vector<Columns> groups = {{"forward_", t.forward, along.forward},
                                 {"u_forward_", t.u_forward, along.u_forward, true},
                                 {"reverse_", t.reverse, along.reverse},
                                 {"u_reverse_", t.u_reverse, along.u_reverse, true}};
  if (t.has_declared()) {
    groups.push_back({"u_random_forward_", t.u_forward, along.u_forward});
    groups.push_back({"u_random_reverse_", t.u_reverse, along.u_reverse});
    groups.push_back({"u_declared_", t.u_declared, along.u_declared});
  }
  CsvText csv;
  csv.cell("position_mm");
  for (const Columns& columns : groups)
    for (const auto& name : error_names(t.axis)) csv.cell(columns.prefix + name.key);
  if (t.has_positioning())
    for (const Columns& columns : groups)
      csv.cell(columns.prefix + positioning_name(t.axis) + "_um");
  if (t.has_positioning()) csv.cell(kSenseColumn);
  csv.cells({"u_covers", "not_declared"}).end_row();
  const std::string covers = covers_text(t), not_declared = joined(t.not_declared, " ");
  for (std::size_t i = 0; i < t.position_m.size(); ++i) {
    csv.cell(to_mm(t.position_m[i]));
    for (const Columns& columns : groups)
      for (std::size_t k = 0; k < 5; ++k) csv.cell(to_key_unit(cell_of(t, columns, k, i)));
    if (t.has_positioning())
      for (const Columns& columns : groups) csv.cell(to_key_unit(cell_along(t, columns, i)));
    if (t.has_positioning()) csv.cell(to_string(kTablePositioningSense));
    csv.cells({covers, not_declared}).end_row();
  }
  return csv.take();
}

}  // namespace mdof::tools
