// Function of Store that stores the uncertainties of the points of a run, for the views in
// schema/sql/013_views.sql.
#include "daemon/store/store.h"
#include "schema/base/json_writer.h"

namespace mdof::store {

using sqlite::Statement;

Status Store::insert_uncertainty(std::int64_t run, const std::optional<RunUncertainty>& known) {
  if (!known) return {};
  JsonWriter keys;
  keys.begin_array();
  for (const std::string& key : known->not_declared) keys.value(std::string_view(key));
  keys.end_array();
  const std::string not_declared = keys.take();
  MDOF_TRY(Statement of_run, connection_.prepare("INSERT INTO run_uncertainty VALUES (?,?,?)"));
  of_run.bind(run).bind(std::int64_t{is_noise_only(*known)}).bind(std::string_view(not_declared));
  MDOF_CHECK(of_run.run());
  MDOF_TRY(Statement insert, connection_.prepare("INSERT INTO point_uncertainty VALUES "
                                                 "(?,?,?,?,?,?,?,?,?,?,?,?)"));
  std::int64_t row = 0;
  for (const ErrorsUncertainty& point : known->points) {
    insert.bind(run).bind(row++);
    for (const double u : point.u) insert.bind(u);
    for (const double k : point.coverage_factor) insert.bind(k);
    MDOF_CHECK(insert.run());
  }
  return {};
}

}  // namespace mdof::store
