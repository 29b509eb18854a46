// Store: a run's plausibility, read back from the JSON in which it is stored.
#include <simdjson.h>

#include <algorithm>
#include <limits>

#include "daemon/store/store.h"
#include "schema/units.h"

namespace mdof::store {
namespace {

using simdjson::dom::array;
using simdjson::dom::element;

// A member that is not there is 0, NaN or empty.
double number(const element& of, const char* key) {
  double x = 0;
  return of[key].get_double().get(x) ? std::numeric_limits<double>::quiet_NaN() : x;
}
std::int64_t integer(const element& of, const char* key) {
  std::int64_t n = 0;
  return of[key].get_int64().get(n) ? 0 : n;
}
std::uint64_t natural(const element& of, const char* key) {
  return static_cast<std::uint64_t>(std::max<std::int64_t>(0, integer(of, key)));
}
std::string text(const element& of, const char* key) {
  std::string_view found;
  return of[key].get_string().get(found) ? "" : std::string(found);
}
std::vector<int> counts(const element& of, const char* key) {
  std::vector<int> found;
  array list;
  if (of[key].get_array().get(list)) return found;
  for (const element n : list) {
    std::int64_t count = 0;
    if (n.get_int64().get(count)) count = 0;
    found.push_back(static_cast<int>(count));
  }
  return found;
}

template <class Read>
void read_each(const element& of, const char* key, Read read) {
  array list;
  if (of[key].get_array().get(list)) return;
  for (const element row : list) read(row);
}

Plausibility plausibility_of(const element& root) {
  Plausibility p;
  p.cycle = text(root, "cycle");
  p.runs = static_cast<int>(integer(root, "runs"));
  read_each(root, "n_ij", [&](const element& row) {
    p.n_ij.push_back(
        {from_mm(number(row, "target_mm")), counts(row, "forward"), counts(row, "reverse")});
  });
  read_each(root, "left_out", [&](const element& row) {
    p.left_out.push_back(
        {from_mm(number(row, "position_mm")), integer(row, "begin_ns"), text(row, "reason")});
  });
  p.short_stops = natural(root, "short_stops");
  p.rate_hz = number(root, "rate_hz");
  p.encoder_min_m = from_mm(number(root, "encoder_min_mm"));
  p.encoder_max_m = from_mm(number(root, "encoder_max_mm"));
  p.scans = natural(root, "scans");
  p.scans_lost = natural(root, "scans_lost");
  p.gaps = natural(root, "gaps");
  read_each(root, "probes", [&](const element& row) {
    p.probes.push_back({text(row, "id"), natural(row, "points"), from_um(number(row, "sd_um")),
                        from_um(number(row, "travel_um")), from_um(number(row, "min_um")),
                        from_um(number(row, "max_um"))});
  });
  return p;
}

}  // namespace

Result<std::optional<Plausibility>> Store::plausibility(std::int64_t run) {
  // A reader takes a database as it is, also one of an older schema.
  MDOF_TRY(const std::int64_t table, connection_.integer("SELECT count(*) FROM sqlite_master "
                                                         "WHERE name = 'run_plausibility'"));
  if (table == 0) return std::optional<Plausibility>();
  MDOF_TRY(sqlite::Statement row,
           connection_.prepare("SELECT json FROM run_plausibility WHERE run = ?"));
  MDOF_TRY(const bool found, row.bind(run).step());
  if (!found) return std::optional<Plausibility>();
  simdjson::dom::parser parser;
  element root;
  if (parser.parse(simdjson::padded_string(row.text(0))).get(root) || !root.is_object())
    return bad_input(file().string() + ": the plausibility of run " + std::to_string(run) +
                     " is not what was stored; restore the database from a backup");
  return std::optional(plausibility_of(root));
}

}  // namespace mdof::store
