// Functions of Store for squareness and compensation tables.
#include <algorithm>
#include <array>
#include <ctime>
#include <limits>
#include <utility>

#include "daemon/store/bytes.h"
#include "daemon/store/ledger.h"
#include "daemon/store/store.h"
#include "schema/rig/rig.h"

namespace mdof::store {

using sqlite::Statement;
using sqlite::Transaction;

namespace {

constexpr double kNotKnown = std::numeric_limits<double>::quiet_NaN();

constexpr std::string_view kTable =
    "SELECT id, axis, simulated, slope_removed, created_utc, sha256, position_m, errors_m_rad, "
    "moves, travel, reference, point_m, chain, chain_travel, added_to "
    "FROM compensation_table ";

// Number of values for each position of a table, without and with declared uncertainties. Tables of
// imported runs have additional values for the positioning.
constexpr std::size_t kSeries = 20, kSeriesWithDeclared = 25;
constexpr std::size_t kPositioning = 4, kPositioningWithDeclared = 5;

struct Parts {
  bool declared = false, positioning = false;
  std::size_t series() const {
    return (declared ? kSeriesWithDeclared : kSeries) + (!positioning ? 0
                                                         : declared   ? kPositioningWithDeclared
                                                                      : kPositioning);
  }
};

// The parts of a table with this number of values. nullopt: no table has this number.
std::optional<Parts> parts_of(std::size_t numbers, std::size_t positions) {
  for (const Parts parts : {Parts{false, false}, {true, false}, {false, true}, {true, true}})
    if (numbers == parts.series() * positions) return parts;
  return std::nullopt;
}

Parts parts_of(const CompensationTable& table) {
  return {table.has_declared(), table.has_positioning()};
}

// Calls `visit` for each series of values, in the order in which they are stored.
template <class Table, class Visit>
void for_each_series(Table& table, const Parts& parts, Visit visit) {
  for (auto* group : {&table.forward, &table.reverse, &table.u_forward, &table.u_reverse})
    for (auto& series : *group) visit(series);
  if (parts.declared)
    for (auto& series : table.u_declared) visit(series);
  if (!parts.positioning) return;
  auto& along = table.positioning;
  for (auto* series : {&along.forward, &along.reverse, &along.u_forward, &along.u_reverse})
    visit(*series);
  if (parts.declared) visit(along.u_declared);
}

Status check_shape(const CompensationTable& table) {
  bool fits = true;
  for_each_series(table, parts_of(table),
                  [&](const auto& s) { fits &= s.size() == table.position_m.size(); });
  if (fits) return {};
  return fail(ErrorCode::usage,
              "compensation table: each error and each u must have one value for each of the " +
                  std::to_string(table.position_m.size()) + " positions");
}

std::vector<double> all_series(const CompensationTable& table) {
  std::vector<double> all;
  for_each_series(table, parts_of(table),
                  [&](const auto& s) { all.insert(all.end(), s.begin(), s.end()); });
  return all;
}

void set_series(CompensationTable& table, const Parts& parts, const std::vector<double>& all) {
  const std::size_t n = table.position_m.size();
  auto from = all.begin();
  for_each_series(table, parts, [&](auto& series) {
    series.assign(from, from + static_cast<std::ptrdiff_t>(n));
    from += static_cast<std::ptrdiff_t>(n);
  });
}

// Binds the reference point, the set-up and the machine of the table.
void bind_statement(Statement& insert, const CompensationTable& t) {
  const std::string travels = chain_travels_text(t.machine);
  insert.bind(std::string_view(t.sides.moves())).bind(std::string_view(t.sides.travel()));
  insert.bind(std::string_view(to_string(t.stated.reference)));
  insert.bind_bytes(bytes_of(t.stated.point_m));
  insert.bind(std::string_view(t.machine.text)).bind(std::string_view(travels));
}

Status read_statement(const Statement& row, CompensationTable& t) {
  t.sides = {row.text(8) == "fixture", row.text(9) == "-"};
  reference_from(row.text(10), t.stated.reference);
  t.lacks_reference_point = row.is_null(11);
  doubles_from(row.bytes(11), t.stated.point_m);
  MDOF_TRY(t.machine, chain_from(row.text(12), row.text(13)));
  return {};
}

// The axes are read from the two runs. The column names say x and y for all axes.
constexpr const char* kSquareness =
    "SELECT s.*, a.axis, b.axis FROM squareness AS s JOIN run AS a ON a.id = s.run_x "
    "JOIN run AS b ON b.id = s.run_y ";

Squareness squareness_from(const Statement& row) {
  Squareness s;
  s.id = row.integer(0);
  s.run_a = row.integer(1);
  s.run_b = row.integer(2);
  s.error_rad = row.real(3);
  s.u_error_rad = row.real(4);
  s.slope_a_rad = row.real(5);
  s.u_slope_a_rad = row.real(6);
  s.slope_b_rad = row.real(7);
  s.u_slope_b_rad = row.real(8);
  s.artefact.angle_error_rad = row.real(9);
  s.simulated = row.integer(10) != 0;
  s.created_utc = row.text(11);
  s.form_rad = row.real(12);
  // Rows of older versions contain the real number 0 if no uncertainty was declared.
  if (row.storage_class(13) == 'i' || row.real(13) > 0) s.artefact.u_rad = row.real(13);
  s.artefact.corner = static_cast<int>(row.integer(14));
  s.axes = {axis_from(row.text(16)).value_or(Axis::x), axis_from(row.text(17)).value_or(Axis::y)};
  // Rows of schema 2 (reference point: carriage) contain form_rad in the column of u_error_rad.
  if (row.text(15) == "carriage") s.form_rad = std::exchange(s.u_error_rad, kNotKnown);
  return s;
}

// Stores an undeclared u as NULL, and a declared u of 0 as an integer (see squareness_from()).
Statement& bind_declared(Statement& to, std::optional<double> u) {
  return u == 0 ? to.bind(std::int64_t{0}) : to.bind(u.value_or(kNotKnown));
}

}  // namespace

Result<std::int64_t> Store::add_squareness(const Squareness& s,
                                           const std::optional<HistoryEntry>& action) {
  for (const std::int64_t run : {s.run_a, s.run_b}) MDOF_CHECK(check_exists(RowOf::run, run));
  MDOF_TRY(Transaction transaction, Transaction::begin(connection_));
  MDOF_TRY(Statement insert,
           connection_.prepare("INSERT INTO squareness (run_x, run_y, EC0Y_rad, u_EC0Y_rad, "
                               "slope_EYX_rad, u_slope_EYX_rad, slope_EXY_rad, u_slope_EXY_rad, "
                               "artefact_angle_error_rad, simulated, created_utc, form_rad, "
                               "u_artefact_rad, artefact_corner, reference) "
                               "VALUES (?,?,?,?,?,?,?,?,?,?,?,?,?,?,'fixture')"));
  insert.bind(s.run_a).bind(s.run_b).bind(s.error_rad).bind(s.u_error_rad);
  insert.bind(s.slope_a_rad).bind(s.u_slope_a_rad);
  insert.bind(s.slope_b_rad).bind(s.u_slope_b_rad).bind(s.artefact.angle_error_rad);
  insert.bind(std::int64_t{s.simulated}).bind(std::string_view(s.created_utc));
  insert.bind(s.form_rad);
  bind_declared(insert, s.artefact.u_rad).bind(std::int64_t{s.artefact.corner});
  MDOF_CHECK(insert.run());
  const std::int64_t id = connection_.last_insert_rowid();
  MDOF_CHECK(add_link(connection_, Fact::squareness, id));
  MDOF_CHECK(insert_action("squareness", id, action));
  MDOF_CHECK(transaction.commit());
  return id;
}

Result<std::vector<Squareness>> Store::list_squareness(std::int64_t offset, std::int64_t count) {
  MDOF_TRY(Statement rows,
           connection_.prepare(std::string(kSquareness) + "ORDER BY s.id DESC LIMIT ?2 OFFSET ?1"));
  rows.bind(offset).bind(count);
  return checked_squareness(rows);
}

Result<std::vector<Squareness>> Store::squareness_of(std::int64_t run_a, std::int64_t run_b) {
  MDOF_TRY(Statement rows,
           connection_.prepare(std::string(kSquareness) +
                               "WHERE s.run_x = ? AND s.run_y = ? ORDER BY s.id DESC"));
  rows.bind(run_a).bind(run_b);
  return checked_squareness(rows);
}

Result<std::vector<Squareness>> Store::checked_squareness(Statement& rows) {
  std::vector<Squareness> list;
  for (;;) {
    MDOF_TRY(const bool row, rows.step());
    if (!row) return list;
    list.push_back(squareness_from(rows));
    MDOF_CHECK(check_link(connection_, Fact::squareness, list.back().id));
  }
}

Result<std::int64_t> Store::add_table(const CompensationTable& table,
                                      const std::optional<HistoryEntry>& action) {
  MDOF_CHECK(check_shape(table));
  for (const std::int64_t run : table.runs) MDOF_CHECK(check_exists(RowOf::run, run));
  if (table.added_to) MDOF_CHECK(check_exists(RowOf::compensation_table, *table.added_to));
  MDOF_TRY(Transaction transaction, Transaction::begin(connection_));
  MDOF_TRY(
      Statement insert,
      connection_.prepare("INSERT INTO compensation_table (id, axis, simulated, slope_removed, "
                          "created_utc, sha256, position_m, errors_m_rad, moves, travel, "
                          "reference, point_m, chain, chain_travel, added_to) "
                          "VALUES (?, ?, ?, ?, ?, ?, ?, ?, ?, ?, ?, ?, ?, ?, ?)"));
  MDOF_TRY(const std::int64_t id, next_table());
  const char axis = letter(table.axis);
  const std::vector<double> errors = all_series(table);
  insert.bind(id).bind(std::string_view(&axis, 1)).bind(std::int64_t{table.simulated});
  insert.bind(std::int64_t{table.slope_removed});
  insert.bind(std::string_view(table.created_utc)).bind(std::string_view(table.sha256));
  insert.bind_bytes(bytes_of(table.position_m)).bind_bytes(bytes_of(errors));
  bind_statement(insert, table);
  insert.bind(table.added_to);
  MDOF_CHECK(insert.run());
  MDOF_TRY(Statement source, connection_.prepare("INSERT INTO compensation_source VALUES (?,?,?)"));
  for (std::size_t row = 0; row < table.runs.size(); ++row)
    MDOF_CHECK(source.bind(id).bind(static_cast<std::int64_t>(row)).bind(table.runs[row]).run());
  MDOF_CHECK(add_link(connection_, Fact::table, id));
  MDOF_CHECK(insert_action("compensation_table", id, action));
  MDOF_CHECK(transaction.commit());
  return id;
}

Result<std::vector<std::int64_t>> Store::integers(std::string_view sql, std::int64_t of) {
  MDOF_TRY(Statement rows, connection_.prepare(sql));
  rows.bind(of);
  std::vector<std::int64_t> list;
  for (;;) {
    MDOF_TRY(const bool row, rows.step());
    if (!row) return list;
    list.push_back(rows.integer(0));
  }
}

Result<CompensationTable> Store::table_of(Statement& row) {
  CompensationTable table;
  table.id = row.integer(0);
  table.axis = axis_from(row.text(1)).value_or(Axis::x);
  table.simulated = row.integer(2) != 0;
  table.slope_removed = row.integer(3) != 0;
  table.created_utc = row.text(4);
  table.sha256 = row.text(5);
  if (!row.is_null(14)) table.added_to = row.integer(14);
  table.position_m = doubles_from(row.bytes(6));
  const std::vector<double> errors = doubles_from(row.bytes(7));
  const auto parts = parts_of(errors.size(), table.position_m.size());
  if (!parts)
    return bad_input(file().string() + ": compensation table " + std::to_string(table.id) +
                     " is damaged; restore the database from a backup");
  MDOF_CHECK(check_link(connection_, Fact::table, table.id));
  set_series(table, *parts, errors);
  MDOF_CHECK(read_statement(row, table));
  MDOF_TRY(table.runs, integers("SELECT run FROM compensation_source WHERE compensation_table = ? "
                                "ORDER BY row",
                                table.id));
  for (const std::int64_t run : table.runs) {
    MDOF_TRY(const RunHeader header, run_header(run));
    if (const auto rig = parse_rig(header.provenance.rig_text, "its rig"))
      add_declarations(table, *rig);
  }
  MDOF_TRY(const auto repeated,
           integers("SELECT target FROM point WHERE direction <> 0 AND reason IS NULL AND run IN "
                    "(SELECT run FROM compensation_source WHERE compensation_table = ?) "
                    "GROUP BY target, direction HAVING count(*) > 1 LIMIT 1",
                    table.id));
  table.visited_once = repeated.empty();
  return table;
}

Result<CompensationTable> Store::table(std::int64_t id) {
  MDOF_CHECK(check_exists(RowOf::compensation_table, id));
  MDOF_TRY(Statement row, connection_.prepare(std::string(kTable) + "WHERE id = ?"));
  MDOF_CHECK(row.bind(id).step());
  return table_of(row);
}

Result<std::vector<CompensationTable>> Store::list_tables(std::int64_t offset, std::int64_t count,
                                                          std::optional<Axis> axis) {
  MDOF_TRY(Statement rows,
           connection_.prepare(std::string(kTable) + "WHERE ?1 IS NULL OR axis = ?1 "
                                                     "ORDER BY id DESC LIMIT ?3 OFFSET ?2"));
  const char letter_of_axis = axis ? letter(*axis) : ' ';
  axis ? rows.bind(std::string_view(&letter_of_axis, 1)) : rows.bind_null();
  rows.bind(offset).bind(count);
  std::vector<CompensationTable> list;
  for (;;) {
    MDOF_TRY(const bool row, rows.step());
    if (!row) return list;
    MDOF_TRY(CompensationTable table, table_of(rows));
    list.push_back(std::move(table));
  }
}

std::string activation_json(const std::string& members, const Activation& activation) {
  const auto truth = [](bool x) { return std::string(x ? "true" : "false"); };
  std::string marks;
  if (const auto& m = activation.marks)
    marks = ",\"simulated\":" + truth(m->simulated) + ",\"doubtful\":" + truth(m->doubtful);
  return "{" + members + ",\"generation\":" + std::to_string(activation.generation) +
         ",\"changed\":" + truth(activation.changed) + marks + "}";
}

namespace {

// Converts "2026-11-22T15:30:00...". Returns 0 for a text with another format.
std::int64_t seconds_since_1970(const std::string& utc) {
  std::tm time{};
  if (::strptime(utc.c_str(), "%Y-%m-%dT%H:%M:%S", &time) == nullptr) return 0;
  return ::timegm(&time);
}

}  // namespace

// A number that no earlier change had, even if the database was deleted and created again. A client
// that knows this number therefore has the data of this generation.
Result<std::int64_t> Store::next_generation(const std::string& utc) {
  MDOF_TRY(const std::int64_t last, generation());
  return std::max(last + 1, seconds_since_1970(utc));
}

Result<Activation> Store::activate(std::int64_t table, const std::string& actor,
                                   const std::string& utc,
                                   const std::optional<HistoryEntry>& action,
                                   std::optional<std::int64_t> expected) {
  MDOF_TRY(Transaction transaction, Transaction::begin(connection_));
  MDOF_CHECK(check_generation(expected));
  MDOF_TRY(const CompensationTable wanted, this->table(table));
  const auto now = active(wanted.axis);
  if (now && now->table.id == table) return Activation{now->generation, false};
  if (!now && now.error().code != ErrorCode::not_found) return tl::unexpected(now.error());
  MDOF_TRY(const std::int64_t generation, next_generation(utc));
  const char axis = letter(wanted.axis);
  MDOF_TRY(Statement insert, connection_.prepare("INSERT INTO activation VALUES (?, ?, ?, ?, ?)"));
  MDOF_CHECK(insert.bind(generation)
                 .bind(std::string_view(&axis, 1))
                 .bind(table)
                 .bind(std::string_view(actor))
                 .bind(std::string_view(utc))
                 .run());
  MDOF_CHECK(add_link(connection_, Fact::activation, generation));
  MDOF_CHECK(insert_action("activation", generation, action));
  MDOF_CHECK(transaction.commit());
  return Activation{generation, true};
}

Result<Activation> Store::deactivate(Axis axis, const std::string& actor, const std::string& utc,
                                     const std::optional<HistoryEntry>& action,
                                     std::optional<std::int64_t> expected) {
  MDOF_TRY(Transaction transaction, Transaction::begin(connection_));
  MDOF_CHECK(check_generation(expected));
  MDOF_TRY(const std::int64_t last, generation());
  const auto now = active(axis);
  if (!now && now.error().code == ErrorCode::not_found) return Activation{last, false};
  MDOF_TRY(const std::int64_t generation, next_generation(utc));
  const char letter_of_axis = letter(axis);
  MDOF_TRY(Statement insert, connection_.prepare("INSERT INTO deactivation VALUES (?, ?, ?, ?)"));
  MDOF_CHECK(insert.bind(generation)
                 .bind(std::string_view(&letter_of_axis, 1))
                 .bind(std::string_view(actor))
                 .bind(std::string_view(utc))
                 .run());
  MDOF_CHECK(add_link(connection_, Fact::deactivation, generation));
  MDOF_CHECK(insert_action("deactivation", generation, action));
  MDOF_CHECK(transaction.commit());
  return Activation{generation, true};
}

// The current activation depends on all activations, so all of them are checked. The check uses no
// index of the database, because a damaged index could omit an activation.
Result<ActiveTable> Store::active(Axis axis) {
  MDOF_CHECK(check_announced_head());
  MDOF_CHECK(check_activations(connection_));
  MDOF_TRY(Statement row,
           connection_.prepare(
               "SELECT generation, compensation_table, actor, activated_utc FROM activation NOT "
               "INDEXED WHERE axis = ?1 AND generation > (SELECT coalesce(max(generation), 0) FROM "
               "deactivation NOT INDEXED WHERE axis = ?1) ORDER BY generation DESC LIMIT 1"));
  const char letter_of_axis = letter(axis);
  MDOF_TRY(const bool found, row.bind(std::string_view(&letter_of_axis, 1)).step());
  if (!found)
    return fail(ErrorCode::not_found, std::string("axis ") + letter_of_axis +
                                          ": no compensation table is active; activate one");
  ActiveTable active;
  active.generation = row.integer(0);
  active.actor = row.text(2);
  active.activated_utc = row.text(3);
  MDOF_TRY(active.table, table(row.integer(1)));
  return active;
}

Result<std::int64_t> Store::generation() {
  return connection_.integer(
      "SELECT max(generation) FROM (SELECT generation FROM activation UNION ALL "
      "SELECT generation FROM deactivation UNION ALL SELECT generation FROM "
      "volumetric_activation)");
}

}  // namespace mdof::store
