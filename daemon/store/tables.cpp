// Store: squareness and compensation tables.
#include <array>

#include "daemon/store/bytes.h"
#include "daemon/store/store.h"

namespace mdof::store {

using sqlite::Statement;
using sqlite::Transaction;

namespace {

constexpr std::string_view kTable =
    "SELECT id, axis, simulated, slope_removed, created_utc, sha256, position_m, errors_m_rad "
    "FROM compensation_table ";

// The series in the order in which they are stored.
template <class Table, class Visit>
void for_each_series(Table& table, Visit visit) {
  for (auto* group : {&table.forward, &table.reverse, &table.u_forward, &table.u_reverse})
    for (auto& series : *group) visit(series);
}

Status check_shape(const CompensationTable& table) {
  bool fits = true;
  for_each_series(table, [&](const auto& s) { fits &= s.size() == table.position_m.size(); });
  if (fits) return {};
  return fail(ErrorCode::usage, "compensation table: each series must have one value for each of " +
                                    std::to_string(table.position_m.size()) + " positions");
}

std::vector<double> all_series(const CompensationTable& table) {
  std::vector<double> all;
  for_each_series(table, [&](const auto& s) { all.insert(all.end(), s.begin(), s.end()); });
  return all;
}

void set_series(CompensationTable& table, const std::vector<double>& all) {
  const std::size_t n = table.position_m.size();
  auto from = all.begin();
  for_each_series(table, [&](auto& series) {
    series.assign(from, from + static_cast<std::ptrdiff_t>(n));
    from += static_cast<std::ptrdiff_t>(n);
  });
}

Squareness squareness_of(const Statement& row) {
  Squareness s;
  s.id = row.integer(0);
  s.run_x = row.integer(1);
  s.run_y = row.integer(2);
  s.EC0Y_rad = row.real(3);
  s.u_EC0Y_rad = row.real(4);
  s.slope_EYX_rad = row.real(5);
  s.u_slope_EYX_rad = row.real(6);
  s.slope_EXY_rad = row.real(7);
  s.u_slope_EXY_rad = row.real(8);
  s.artefact_angle_error_rad = row.real(9);
  s.simulated = row.integer(10) != 0;
  s.created_utc = row.text(11);
  return s;
}

}  // namespace

Result<std::int64_t> Store::add_squareness(const Squareness& s) {
  for (const std::int64_t run : {s.run_x, s.run_y})
    MDOF_CHECK(check_exists("SELECT 1 FROM run WHERE id = ?", "run", run));
  MDOF_TRY(Statement insert,
           connection_.prepare("INSERT INTO squareness (run_x, run_y, EC0Y_rad, u_EC0Y_rad, "
                               "slope_EYX_rad, u_slope_EYX_rad, slope_EXY_rad, u_slope_EXY_rad, "
                               "artefact_angle_error_rad, simulated, created_utc) "
                               "VALUES (?,?,?,?,?,?,?,?,?,?,?)"));
  insert.bind(s.run_x).bind(s.run_y).bind(s.EC0Y_rad).bind(s.u_EC0Y_rad);
  insert.bind(s.slope_EYX_rad).bind(s.u_slope_EYX_rad);
  insert.bind(s.slope_EXY_rad).bind(s.u_slope_EXY_rad).bind(s.artefact_angle_error_rad);
  insert.bind(std::int64_t{s.simulated}).bind(std::string_view(s.created_utc));
  MDOF_CHECK(insert.run());
  return connection_.last_insert_rowid();
}

Result<std::vector<Squareness>> Store::list_squareness(std::int64_t offset, std::int64_t count) {
  MDOF_TRY(Statement rows, connection_.prepare("SELECT * FROM squareness ORDER BY id DESC "
                                               "LIMIT ?2 OFFSET ?1"));
  rows.bind(offset).bind(count);
  std::vector<Squareness> list;
  for (;;) {
    MDOF_TRY(const bool row, rows.step());
    if (!row) return list;
    list.push_back(squareness_of(rows));
  }
}

Result<std::int64_t> Store::add_table(const CompensationTable& table) {
  MDOF_CHECK(check_shape(table));
  for (const std::int64_t run : table.runs)
    MDOF_CHECK(check_exists("SELECT 1 FROM run WHERE id = ?", "run", run));
  MDOF_TRY(Transaction transaction, Transaction::begin(connection_));
  MDOF_TRY(Statement insert,
           connection_.prepare("INSERT INTO compensation_table (axis, simulated, slope_removed, "
                               "created_utc, sha256, position_m, errors_m_rad) "
                               "VALUES (?, ?, ?, ?, ?, ?, ?)"));
  const char axis = letter(table.axis);
  const std::vector<double> errors = all_series(table);
  insert.bind(std::string_view(&axis, 1)).bind(std::int64_t{table.simulated});
  insert.bind(std::int64_t{table.slope_removed});
  insert.bind(std::string_view(table.created_utc)).bind(std::string_view(table.sha256));
  insert.bind_bytes(bytes_of(table.position_m)).bind_bytes(bytes_of(errors));
  MDOF_CHECK(insert.run());
  const std::int64_t id = connection_.last_insert_rowid();
  MDOF_TRY(Statement source, connection_.prepare("INSERT INTO compensation_source VALUES (?,?,?)"));
  for (std::size_t row = 0; row < table.runs.size(); ++row)
    MDOF_CHECK(source.bind(id).bind(static_cast<std::int64_t>(row)).bind(table.runs[row]).run());
  MDOF_CHECK(transaction.commit());
  return id;
}

Result<std::vector<std::int64_t>> Store::sources(std::int64_t table) {
  MDOF_TRY(Statement rows, connection_.prepare("SELECT run FROM compensation_source WHERE "
                                               "compensation_table = ? ORDER BY row"));
  rows.bind(table);
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
  table.position_m = doubles_from(row.bytes(6));
  const std::vector<double> errors = doubles_from(row.bytes(7));
  if (errors.size() != 20 * table.position_m.size())
    return bad_input(file().string() + ": compensation table " + std::to_string(table.id) +
                     " is damaged; restore the database from a backup");
  set_series(table, errors);
  MDOF_TRY(table.runs, sources(table.id));
  return table;
}

Result<CompensationTable> Store::table(std::int64_t id) {
  MDOF_CHECK(
      check_exists("SELECT 1 FROM compensation_table WHERE id = ?", "compensation table", id));
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

Result<std::int64_t> Store::activate(std::int64_t table, const std::string& actor,
                                     const std::string& utc) {
  MDOF_CHECK(
      check_exists("SELECT 1 FROM compensation_table WHERE id = ?", "compensation table", table));
  MDOF_TRY(Statement insert,
           connection_.prepare("INSERT INTO activation (generation, axis, compensation_table, "
                               "actor, activated_utc) SELECT (SELECT coalesce(max(generation), 0) "
                               "+ 1 FROM activation), axis, id, ?, ? FROM compensation_table "
                               "WHERE id = ?"));
  MDOF_CHECK(insert.bind(std::string_view(actor)).bind(std::string_view(utc)).bind(table).run());
  return connection_.last_insert_rowid();
}

Result<ActiveTable> Store::active(Axis axis) {
  MDOF_TRY(Statement row,
           connection_.prepare("SELECT generation, compensation_table, actor, activated_utc FROM "
                               "activation WHERE axis = ? ORDER BY generation DESC LIMIT 1"));
  const char letter_of_axis = letter(axis);
  MDOF_TRY(const bool found, row.bind(std::string_view(&letter_of_axis, 1)).step());
  if (!found)
    return fail(ErrorCode::not_found, std::string("axis ") + letter_of_axis +
                                          ": no compensation table is active; activate one");
  ActiveTable active{{}, row.integer(0), std::string(row.text(2)), std::string(row.text(3))};
  MDOF_TRY(active.table, table(row.integer(1)));
  return active;
}

Result<std::int64_t> Store::generation() {
  return connection_.integer("SELECT max(generation) FROM activation");
}

}  // namespace mdof::store
