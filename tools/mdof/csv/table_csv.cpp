#include "tools/mdof/csv/table_csv.h"

#include "schema/imported/series.h"
#include "schema/iso230/positioning.h"
#include "schema/units.h"
#include "tools/mdof/csv/csv_text.h"

namespace mdof::tools {

std::string table_csv(const CompensationTable& t) {
  const struct {
    const char* prefix;
    const std::array<std::vector<double>, 5>& values;
  } groups[] = {{"forward_", t.forward},
                {"u_forward_", t.u_forward},
                {"reverse_", t.reverse},
                {"u_reverse_", t.u_reverse}};
  CsvText csv;
  csv.cell("position_mm");
  for (const auto& group : groups)
    for (const auto& name : error_names(t.axis)) csv.cell(std::string(group.prefix) + name.key);
  const bool declared = t.has_declared();
  if (declared)
    for (const auto& name : error_names(t.axis)) csv.cell(std::string("u_declared_") + name.key);
  const auto& along = t.positioning;
  const std::string key = positioning_name(t.axis) + "_um";
  if (t.has_positioning())
    for (const char* prefix : {"forward_", "u_forward_", "reverse_", "u_reverse_", "u_declared_"})
      csv.cell(prefix + key);
  csv.end_row();
  for (std::size_t i = 0; i < t.position_m.size(); ++i) {
    csv.cell(to_mm(t.position_m[i]));
    for (const auto& group : groups)
      for (const auto& series : group.values) csv.cell(to_key_unit(series[i]));
    if (declared)
      for (const auto& series : t.u_declared) csv.cell(to_key_unit(series[i]));
    if (t.has_positioning()) {
      for (const auto* series :
           {&along.forward, &along.u_forward, &along.reverse, &along.u_reverse})
        csv.cell(to_key_unit((*series)[i]));
      csv.cell(declared ? to_key_unit(along.u_declared[i]) : kNoFigure);
    }
    csv.end_row();
  }
  return csv.take();
}

}  // namespace mdof::tools
