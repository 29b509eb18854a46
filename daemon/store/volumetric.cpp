// Functions of Store for volumetric tables, their activation, and the check of the expected
// generation.
#include "daemon/store/bytes.h"
#include "daemon/store/ledger.h"
#include "daemon/store/store.h"
#include "schema/base/json_writer.h"
#include "schema/notice/notice_json.h"
#include "schema/volumetric/volumetric_table.h"

namespace mdof::store {

using sqlite::Statement;
using sqlite::Transaction;

namespace {

constexpr std::string_view kVolumetric =
    "SELECT v.id, v.machine, document.text, v.chain, v.chain_travel, v.simulated, v.noise_only, "
    "v.approach, v.tool_m, v.rotary_rad, v.X_m, v.Y_m, v.Z_m, v.correction_m, v.u_m, "
    "v.interpolation_m, v.place_left_m, v.turn_left_rad, v.not_measured, v.u_not_declared, "
    "v.beyond_tables, v.created_utc, v.sha256, v.u_independent_m, v.noise, "
    "v.reversal_m, v.doubtful, v.noise_only_all, v.u_between_m "
    "FROM volumetric_table AS v JOIN document ON document.id = v.description ";

std::vector<double> flat(const std::vector<Vec3>& values) {
  std::vector<double> all;
  for (const Vec3& v : values) all.insert(all.end(), v.begin(), v.end());
  return all;
}

std::vector<Vec3> vectors_from(std::string_view bytes) {
  const std::vector<double> all = doubles_from(bytes);
  std::vector<Vec3> values;
  for (std::size_t i = 0; i + 2 < all.size(); i += 3)
    values.push_back({all[i], all[i + 1], all[i + 2]});
  return values;
}

std::string json_list(const std::vector<std::string>& names) {
  JsonWriter json;
  json.begin_array();
  for (const std::string& name : names) json.value(name);
  json.end_array();
  return json.take();
}

Status check_shape(const VolumetricTable& t) {
  bool parts = t.u_independent_m.empty() || t.u_independent_m.size() == t.nodes();
  for (std::size_t k = 0; k < 3; ++k)
    parts = parts && (t.noise[k].empty() || t.noise[k].size() == t.command_m[k].size()) &&
            (!t.has_u_between() || t.u_between_m[k].size() + 1 == t.command_m[k].size());
  if (t.nodes() > 0 && t.correction_m.size() == t.nodes() && t.u_m.size() == t.nodes() && parts)
    return {};
  return fail(ErrorCode::usage,
              "volumetric table: the corrections and their u must have one value for each of the " +
                  std::to_string(t.nodes()) + " nodes");
}

// SQLite does not copy bound bytes. Therefore this object must exist until the statement is
// executed.
struct FlatNodes {
  explicit FlatNodes(const VolumetricTable& t)
      : correction(flat(t.correction_m)),
        u(flat(t.u_m)),
        u_independent(flat(t.u_independent_m)),
        noise(noise_numbers(t)),
        u_between(u_between_numbers(t)) {}
  std::vector<double> correction, u, u_independent, noise, u_between;
};

void bind_values(Statement& insert, const VolumetricTable& t, const FlatNodes& nodes) {
  insert.bind_bytes(bytes_of(t.tool_m)).bind_bytes(bytes_of(t.rotary_rad));
  for (const auto& commands : t.command_m) insert.bind_bytes(bytes_of(commands));
  insert.bind_bytes(bytes_of(nodes.correction)).bind_bytes(bytes_of(nodes.u));
  insert.bind_bytes(bytes_of(t.interpolation_m)).bind(t.place_left_m).bind(t.turn_left_rad);
  for (const auto* names : {&t.not_measured, &t.u_not_declared, &t.beyond_tables}) {
    const std::string list = json_list(*names);
    insert.bind(std::string_view(list));
  }
  insert.bind_bytes(bytes_of(nodes.u_independent)).bind_bytes(bytes_of(nodes.noise));
  insert.bind_bytes(bytes_of(t.reversal_m));
}

}  // namespace

Result<std::int64_t> Store::next_table() {
  return connection_.integer(
      "SELECT coalesce(max(id), 0) + 1 FROM (SELECT id FROM compensation_table UNION ALL SELECT id "
      "FROM volumetric_table)");
}

Result<std::int64_t> Store::add_volumetric(const VolumetricTable& table,
                                           const std::optional<HistoryEntry>& action) {
  MDOF_CHECK(check_shape(table));
  for (const std::int64_t run : table.runs) MDOF_CHECK(check_exists(RowOf::run, run));
  MDOF_TRY(Transaction transaction, Transaction::begin(connection_));
  MDOF_TRY(const std::int64_t id, next_table());
  MDOF_TRY(const std::int64_t description, document_id(table.description));
  MDOF_TRY(Statement insert,
           connection_.prepare(
               "INSERT INTO volumetric_table (id, machine, description, chain, chain_travel, "
               "simulated, noise_only, approach, created_utc, sha256, tool_m, rotary_rad, X_m, "
               "Y_m, Z_m, correction_m, u_m, interpolation_m, place_left_m, turn_left_rad, "
               "not_measured, u_not_declared, beyond_tables, u_independent_m, noise, "
               "reversal_m, doubtful, noise_only_all, u_between_m) VALUES "
               "(?,?,?,?,?,?,?,?,?,?,?,?,?,?,?,?,?,?,?,?,?,?,?,?,?,?,?,?,?)"));
  const std::string travels = chain_travels_text(table.machine);
  insert.bind(id).bind(std::string_view(table.name)).bind(description);
  insert.bind(std::string_view(table.machine.text)).bind(std::string_view(travels));
  insert.bind(std::int64_t{table.simulated});
  insert.bind(std::int64_t{table.noise_only != NoiseOnly::none});
  insert.bind(std::string_view(table.approach)).bind(std::string_view(table.created_utc));
  insert.bind(std::string_view(table.sha256));
  const FlatNodes nodes(table);
  bind_values(insert, table, nodes);
  const std::string doubtful = notices_json(table.doubtful);
  if (table.doubtful.empty())
    insert.bind_null();
  else
    insert.bind(std::string_view(doubtful));
  insert.bind(std::int64_t{table.noise_only == NoiseOnly::all});
  insert.bind_bytes(bytes_of(nodes.u_between));
  MDOF_CHECK(insert.run());
  MDOF_TRY(Statement source, connection_.prepare("INSERT INTO volumetric_source VALUES (?,?,?)"));
  for (std::size_t row = 0; row < table.runs.size(); ++row)
    MDOF_CHECK(source.bind(id).bind(static_cast<std::int64_t>(row)).bind(table.runs[row]).run());
  MDOF_CHECK(add_link(connection_, Fact::volumetric_table, id));
  MDOF_CHECK(insert_action("volumetric_table", id, action));
  MDOF_CHECK(transaction.commit());
  return id;
}

Result<VolumetricTable> Store::volumetric_of(Statement& row) {
  VolumetricTable t;
  t.id = row.integer(0);
  MDOF_CHECK(check_link(connection_, Fact::volumetric_table, t.id));
  t.name = row.text(1);
  t.description = row.text(2);
  MDOF_TRY(t.machine, chain_from(row.text(3), row.text(4)));
  t.simulated = row.integer(5) != 0;
  t.noise_only = row.integer(6) == 0                        ? NoiseOnly::none
                 : !row.is_null(27) && row.integer(27) != 0 ? NoiseOnly::all
                                                            : NoiseOnly::some;
  t.approach = row.text(7);
  doubles_from(row.bytes(8), t.tool_m);
  doubles_from(row.bytes(9), t.rotary_rad);
  for (std::size_t k = 0; k < 3; ++k)
    t.command_m[k] = doubles_from(row.bytes(10 + static_cast<int>(k)));
  t.correction_m = vectors_from(row.bytes(13));
  t.u_m = vectors_from(row.bytes(14));
  doubles_from(row.bytes(15), t.interpolation_m);
  t.place_left_m = row.real(16);
  t.turn_left_rad = row.real(17);
  int column = 18;
  for (auto* names : {&t.not_measured, &t.u_not_declared, &t.beyond_tables}) {
    MDOF_TRY(*names, texts(row.text(column++)));
  }
  t.created_utc = row.text(21);
  t.sha256 = row.text(22);
  t.u_independent_m = vectors_from(row.bytes(23));
  if (!set_noise(t, doubles_from(row.bytes(24))) ||
      !set_u_between(t, doubles_from(row.bytes(28))) || !check_shape(t))
    return bad_input(file().string() + ": volumetric table " + std::to_string(t.id) +
                     " is damaged; restore the database from a backup");
  doubles_from(row.bytes(25), t.reversal_m);
  MDOF_TRY(t.runs, integers("SELECT run FROM volumetric_source WHERE volumetric_table = ? ORDER BY "
                            "row",
                            t.id));
  if (!row.is_null(26)) {
    MDOF_TRY(t.doubtful, read_notices(row.text(26)));
  }
  // The chain of hashes contains the hash of the table, but not every column. So the hash of the
  // table is checked here.
  if (volumetric_sha256(t) != t.sha256)
    return bad_input(file().string() + ": volumetric table " + std::to_string(t.id) +
                         " was changed after it was stored (the hash differs)",
                     Remedy::verify_database);
  return t;
}

Result<VolumetricTable> Store::volumetric(std::int64_t id) {
  MDOF_CHECK(check_exists(RowOf::volumetric_table, id));
  MDOF_TRY(Statement row, connection_.prepare(std::string(kVolumetric) + "WHERE v.id = ?"));
  MDOF_CHECK(row.bind(id).step());
  return volumetric_of(row);
}

Result<bool> Store::is_volumetric(std::int64_t id) {
  MDOF_TRY(Statement row, connection_.prepare("SELECT 1 FROM volumetric_table WHERE id = ?"));
  return row.bind(id).step();
}

Result<std::vector<VolumetricTable>> Store::list_volumetric(std::int64_t offset,
                                                            std::int64_t count) {
  MDOF_TRY(Statement rows,
           connection_.prepare(std::string(kVolumetric) + "ORDER BY v.id DESC LIMIT ?2 OFFSET ?1"));
  rows.bind(offset).bind(count);
  std::vector<VolumetricTable> list;
  for (;;) {
    MDOF_TRY(const bool row, rows.step());
    if (!row) return list;
    MDOF_TRY(VolumetricTable table, volumetric_of(rows));
    list.push_back(std::move(table));
  }
}

Result<Activation> Store::change_volumetric(std::optional<std::int64_t> table,
                                            const std::string& actor, const std::string& utc,
                                            const std::optional<HistoryEntry>& action,
                                            std::optional<std::int64_t> expected) {
  MDOF_TRY(Transaction transaction, Transaction::begin(connection_));
  MDOF_CHECK(check_generation(expected));
  if (table) MDOF_CHECK(check_exists(RowOf::volumetric_table, *table));
  const auto now = active_volumetric();
  if (!now && now.error().code != ErrorCode::not_found && table) return tl::unexpected(now.error());
  const bool none = !now && now.error().code == ErrorCode::not_found;
  if (now && table == now->table.id) return Activation{now->generation, false};
  if (none && !table) {
    MDOF_TRY(const std::int64_t last, generation());
    return Activation{last, false};
  }
  MDOF_TRY(const std::int64_t generation, next_generation(utc));
  MDOF_TRY(Statement insert,
           connection_.prepare("INSERT INTO volumetric_activation VALUES (?, ?, ?, ?)"));
  insert.bind(generation).bind(table);
  MDOF_CHECK(insert.bind(std::string_view(actor)).bind(std::string_view(utc)).run());
  MDOF_CHECK(add_link(connection_, Fact::volumetric_activation, generation));
  MDOF_CHECK(insert_action("volumetric_activation", generation, action));
  MDOF_CHECK(transaction.commit());
  return Activation{generation, true};
}

Result<ActiveVolumetric> Store::active_volumetric() {
  MDOF_CHECK(check_announced_head());
  MDOF_CHECK(check_activations(connection_));
  MDOF_TRY(Statement row,
           connection_.prepare("SELECT generation, volumetric_table, actor, activated_utc FROM "
                               "volumetric_activation NOT INDEXED ORDER BY generation DESC "
                               "LIMIT 1"));
  MDOF_TRY(const bool found, row.step());
  if (!found || row.is_null(1))
    return fail(ErrorCode::not_found, "no volumetric table is active; activate one");
  ActiveVolumetric active;
  active.generation = row.integer(0);
  active.actor = row.text(2);
  active.activated_utc = row.text(3);
  MDOF_TRY(active.table, volumetric(row.integer(1)));
  return active;
}

// Time between the first and the last scan. A run that an older version stored has no such time;
// then it is the time between its first and its last point.
Result<double> Store::measured_s(std::int64_t run) {
  MDOF_TRY(Statement row,
           connection_.prepare(
               "SELECT coalesce((SELECT json_extract(json, '$.duration_s') FROM run_plausibility "
               "WHERE run = ?1), (SELECT (max(end_ns) - min(begin_ns)) / 1e9 FROM point WHERE id "
               "BETWEEN (?1 << 32) AND (?1 << 32) + 4294967295), 0.0)"));
  MDOF_CHECK(row.bind(run).step());
  return row.real(0);
}

// Times are compared as texts, so the start has milliseconds like the times of activations. If the
// start is not known, the run has the day that the rig states (and was measured before it
// was stored), or the time of its evaluation. '9' is later than every time.
Result<TablesOfRun> Store::active_during(const RunHeader& run,
                                         std::optional<std::int64_t> continued) {
  MDOF_TRY(double length_s, measured_s(run.id));
  if (continued) {
    MDOF_TRY(const double before_s, measured_s(*continued));
    length_s = std::max(0.0, length_s - before_s);
  }
  constexpr std::string_view kMeasured =
      "WITH measured AS (SELECT axis, CASE WHEN ?2 THEN strftime('%Y-%m-%dT%H:%M:%fZ', "
      "started_utc) ELSE started_utc END AS start, CASE WHEN ?2 THEN "
      "strftime('%Y-%m-%dT%H:%M:%fZ', started_utc, ?3 || ' seconds') "
      "WHEN length(started_utc) = 10 THEN min(date(started_utc, '+1 day'), coalesce((SELECT "
      "max(utc) FROM deed WHERE name = 'run.replay' AND row = ?1), '9')) "
      "ELSE started_utc END AS stop FROM run WHERE id = ?1) ";
  constexpr std::string_view kLater =
      "SELECT compensation_table FROM activation, measured WHERE activation.axis = measured.axis "
      "AND activated_utc > start AND activated_utc <= stop "
      "UNION SELECT volumetric_table FROM volumetric_activation, measured WHERE "
      "activated_utc > start AND activated_utc <= stop";
  TablesOfRun found;
  MDOF_TRY(
      Statement row,
      connection_.prepare(
          std::string(kMeasured) +
          "SELECT * FROM (SELECT compensation_table FROM activation, measured WHERE "
          "activation.axis = measured.axis AND activated_utc <= start AND generation > (SELECT "
          "coalesce(max(generation), 0) FROM deactivation WHERE deactivation.axis = measured.axis "
          "AND deactivated_utc <= start) ORDER BY generation DESC LIMIT 1) "
          "UNION SELECT * FROM (SELECT volumetric_table FROM volumetric_activation, measured WHERE "
          "activated_utc <= start ORDER BY generation DESC LIMIT 1) UNION " +
          std::string(kLater) + " ORDER BY 1"));
  row.bind(run.id).bind(std::int64_t{run.start_known}).bind(length_s);
  for (;;) {
    MDOF_TRY(const bool is_row, row.step());
    if (!is_row) break;
    if (!row.is_null(0)) found.tables.push_back(row.integer(0));  // null: deactivated
  }
  MDOF_TRY(Statement changes,
           connection_.prepare(
               std::string(kMeasured) + "SELECT EXISTS (" + std::string(kLater) +
               " UNION SELECT generation FROM deactivation, measured WHERE deactivation.axis = "
               "measured.axis AND deactivated_utc > start AND deactivated_utc <= stop)"));
  changes.bind(run.id).bind(std::int64_t{run.start_known}).bind(length_s);
  MDOF_CHECK(changes.step());
  found.changed = changes.integer(0) != 0;
  return found;
}

// List of the active tables, "axis X table 3, volume table 7".
std::string Store::active_text() {
  std::string text;
  const auto add = [&](const std::string& of, const auto& active) {
    if (!active && active.error().code == ErrorCode::not_found) return;
    text += (text.empty() ? "" : ", ") + of + " table " +
            (active ? std::to_string(active->table.id) : std::string("(unreadable)"));
  };
  for (const Axis axis : {Axis::x, Axis::y, Axis::z})
    add(std::string("axis ") + letter(axis), active(axis));
  add("volume", active_volumetric());
  return text.empty() ? "none" : text;
}

Status Store::check_generation(std::optional<std::int64_t> expected) {
  if (!expected) return {};
  MDOF_TRY(const std::int64_t now, generation());
  if (now == *expected) return {};
  return fail(ErrorCode::changed,
              "your change was not made, because the active tables have changed since you read "
              "them: the generation is " +
                  std::to_string(now) + ", not " + std::to_string(*expected) + "; active now: " +
                  active_text() + "; read the active tables again, then decide again");
}

}  // namespace mdof::store
