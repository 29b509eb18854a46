#include "tools/mdof/text/analyses/means_text.h"

#include <cmath>
#include <vector>

#include "algo/compensation/compensation.h"
#include "daemon/measure/evaluation.h"
#include "schema/axis.h"
#include "schema/uncertainty/covers.h"
#include "tools/mdof/text/run_tables.h"
#include "tools/mdof/text/text_table.h"

namespace mdof::tools {
namespace {

std::vector<algo::TableValue> mean_values(const CompensationTable& means) {
  std::vector<algo::TableValue> values;
  for (const double position_m : means.position_m)
    values.push_back(algo::table_at(means, position_m, algo::TableSide::mean));
  return values;
}

std::string mean_rows(const CompensationTable& means, std::size_t width) {
  const std::vector<algo::TableValue> values = mean_values(means);
  const auto& names = error_names(means.axis);
  std::vector<std::string> head{"target", "at/mm"};
  Errors5 column{};
  for (std::size_t k = 0; k < kErrorCount; ++k) {
    head.push_back(error_label(names[k].key));
    std::vector<double> u;
    for (const algo::TableValue& value : values) u.push_back(value.u[k]);
    column[k] = column_u(u);
  }
  TextTable table(std::move(head), 2);
  for (std::size_t i = 0; i < values.size(); ++i) {
    std::vector<std::string> row{std::to_string(i + 1), in_mm(means.position_m[i])};
    for (std::size_t k = 0; k < kErrorCount; ++k) {
      const double error = values[i].error[k], u = values[i].u[k];
      row.push_back(!std::isfinite(error) ? "-"
                    : names[k].angle      ? urad_with_u(error, u, column[k])
                                          : um_with_u(error, u, column[k]));
    }
    table.add(std::move(row));
  }
  return table.text(width);
}

}  // namespace

std::string means_text(const Run& run, std::size_t width) {
  const auto means = daemon::means_by_target(run);
  if (!means) return "";
  return "mean of all passes and approaches\n" + mean_rows(*means, width) +
         wrapped("± is the standard uncertainty u. It contains " + covers_text(covers(*means)) +
                     ". error = actual - nominal position of the moving " +
                     run.header.sides.moves() + "; angles relative to the first target",
                 width) +
         "\n" + stated_text(run.header.stated);
}

}  // namespace mdof::tools
