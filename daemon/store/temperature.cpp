// Functions of Store for the measured temperature of a run.
#include "daemon/store/store.h"

namespace mdof::store {

using sqlite::Statement;

Status Store::insert_temperature(std::int64_t run, const std::optional<Temperature>& read) {
  if (!read) return {};
  MDOF_TRY(Statement insert, connection_.prepare("INSERT INTO run_temperature VALUES (?,?,?,?)"));
  return insert.bind(run).bind(read->mean_C).bind(read->min_C).bind(read->max_C).run();
}

Result<std::optional<Temperature>> Store::temperature(std::int64_t run) {
  MDOF_TRY(Statement row, connection_.prepare("SELECT mean_C, min_C, max_C FROM run_temperature "
                                              "WHERE run = ?"));
  MDOF_TRY(const bool found, row.bind(run).step());
  if (!found) return std::optional<Temperature>();
  return std::optional(Temperature{row.real(0), row.real(1), row.real(2)});
}

}  // namespace mdof::store
