// Function of Store that reads the plausibility of a run from the stored JSON.
#include "daemon/store/store.h"
#include "schema/plausibility/plausibility_json.h"

namespace mdof::store {

Result<std::optional<Plausibility>> Store::plausibility(std::int64_t run) {
  // The schema may be older and not contain this table, because a reader does not migrate the
  // database.
  MDOF_TRY(const std::int64_t table, connection_.integer("SELECT count(*) FROM sqlite_master "
                                                         "WHERE name = 'run_plausibility'"));
  if (table == 0) return std::optional<Plausibility>();
  MDOF_TRY(sqlite::Statement row,
           connection_.prepare("SELECT json FROM run_plausibility WHERE run = ?"));
  MDOF_TRY(const bool found, row.bind(run).step());
  if (!found) return std::optional<Plausibility>();
  auto stored = read_plausibility_json(std::string(row.text(0)));
  if (stored) return std::optional(std::move(*stored));
  return bad_input(file().string() + ": the results of the plausibility checks of run " +
                   std::to_string(run) + " were changed after they were stored: " +
                   stored.error().message + "; restore the database from a backup");
}

}  // namespace mdof::store
