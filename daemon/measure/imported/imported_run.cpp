#include "daemon/measure/imported/imported_run.h"

#include <cmath>

#include "algo/compensation/imported_table.h"
#include "daemon/history.h"
#include "daemon/words/words.h"
#include "schema/imported/imported_json.h"
#include "schema/imported/series.h"
#include "schema/recording/run_options.h"
#include "schema/uncertainty/budget_json.h"

namespace mdof::daemon {

TableRequest imported_table_request(const Run& run, const Run& other) {
  TableRequest request;
  request.runs = {run.header.id};
  request.partial = true;
  const ImportedSense a = run_options(run.header).imported, b = run_options(other.header).imported;
  if (a.sense == b.sense && !a.against_command && !b.against_command)
    request.against_command = false;
  return request;
}

Run with_positioning_notices(Run run) {
  if (run.header.provenance.model == positioning_name(run.header.axis))
    append(run.header.notices, algo::positioning_notices({run}));
  return run;
}

Covers readings_coverage(const Run& run) {
  const bool is_declared =
      !run.points.empty() && !std::isnan(deviation_uncertainty(run.points.front()));
  return {is_declared ? Covered::declared_at_import : Covered::undeclared_at_import,
          Covered::no_repeatability};
}

std::string imported_document(const Run& run, const RunHeader& header, const StatedFigures& figures,
                              const std::string& result_sha256,
                              const std::vector<HistoryEntry>& actions, bool with_points) {
  JsonWriter json;
  json.begin_object();
  write_imported_members(json, header, words::text);
  if (!figures.budgets.empty()) write_covers(json, figures.budgets);
  write_stated(json, figures);
  json.field("points_total", static_cast<std::uint64_t>(run.points.size()));
  if (with_points) {
    const std::string key = imported_run_error(run.header).key();
    json.key("points").begin_array();
    for (const MeasuredPoint& p : run.points) write_imported_point(json, p, key);
    json.end_array();
  }
  json.field("result_sha256", result_sha256).key("history");
  write_actions(json, actions);
  json.end_object();
  return json.take();
}

}  // namespace mdof::daemon
