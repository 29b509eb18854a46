// Functions of Store for the history of actions and users.
#include "daemon/store/ledger.h"
#include "daemon/store/store.h"

namespace mdof::store {

using sqlite::Statement;

namespace {

constexpr std::string_view kActions =
    "SELECT id, name, subject, row, uid, gid, pid, user, utc FROM deed ";

// The query for the changed table as text, and the kind of the row. The row is a generation.
struct Changed {
  std::string_view subject, query;
  Fact fact;
};
constexpr Changed kChangedRows[] = {
    {"activation",
     "SELECT 'table ' || compensation_table || ' of ' || axis FROM activation WHERE generation = ?",
     Fact::activation},
    {"deactivation",  // the table that was active until then
     "SELECT 'table ' || (SELECT compensation_table FROM activation WHERE axis = d.axis AND "
     "generation < d.generation ORDER BY generation DESC LIMIT 1) || ' of ' || axis FROM "
     "deactivation AS d WHERE generation = ?",
     Fact::deactivation},
    {"volumetric_activation",
     "SELECT 'table ' || volumetric_table || ' of the volume' FROM volumetric_activation WHERE "
     "generation <= ? AND volumetric_table IS NOT NULL ORDER BY generation DESC LIMIT 1",
     Fact::volumetric_activation},
};

HistoryEntry caller_action(const Statement& row) {
  HistoryEntry action;
  action.id = row.integer(0);
  action.name = row.text(1);
  action.subject = row.text(2);
  action.row = row.integer(3);
  action.by = {row.integer(4), row.integer(5), row.integer(6), std::string(row.text(7))};
  action.utc = row.text(8);
  return action;
}

}  // namespace

Status Store::insert_action(std::string_view subject, std::int64_t row,
                            const std::optional<HistoryEntry>& action) {
  if (!action) return {};
  MDOF_TRY(Statement insert,
           connection_.prepare("INSERT INTO deed (name, subject, row, uid, gid, pid, user, utc) "
                               "VALUES (?, ?, ?, ?, ?, ?, ?, ?)"));
  insert.bind(std::string_view(action->name)).bind(subject).bind(row);
  insert.bind(action->by.uid).bind(action->by.gid).bind(action->by.pid);
  insert.bind(std::string_view(action->by.user)).bind(std::string_view(action->utc));
  MDOF_CHECK(insert.run());
  const std::int64_t id = connection_.last_insert_rowid();
  MDOF_CHECK(add_link(connection_, Fact::action, id));
  return action->detail.empty() ? Status() : insert_reason(id, action->detail);
}

Status Store::insert_reason(std::int64_t action, std::string_view text) {
  MDOF_TRY(Statement insert,
           connection_.prepare("INSERT INTO deed_reason (deed, text) VALUES (?, ?)"));
  insert.bind(action).bind(text);
  MDOF_CHECK(insert.run());
  return add_link(connection_, Fact::action_reason, action);
}

Result<std::vector<HistoryEntry>> Store::read_actions(Statement& rows) {
  std::vector<HistoryEntry> list;
  for (;;) {
    MDOF_TRY(const bool row, rows.step());
    if (!row) return list;
    list.push_back(caller_action(rows));
    MDOF_CHECK(check_link(connection_, Fact::action, list.back().id));
    MDOF_CHECK(add_detail(list.back()));
  }
}

Status Store::add_detail(HistoryEntry& action) {
  if (action.subject == "encoder_datum") {
    MDOF_TRY(const auto setting, datum(action.row));
    if (setting) action.detail = setting_text(*setting);
    return {};
  }
  for (const Changed& changed : kChangedRows) {
    if (action.subject != changed.subject) continue;
    MDOF_TRY(Statement table, connection_.prepare(std::string(changed.query)));
    MDOF_TRY(const bool known, table.bind(action.row).step());
    if (known) action.detail = table.text(0);
    MDOF_CHECK(check_link(connection_, changed.fact, action.row));
  }
  MDOF_TRY(Statement reason, connection_.prepare("SELECT text FROM deed_reason WHERE deed = ?"));
  MDOF_TRY(const bool found, reason.bind(action.id).step());
  if (!found) return {};
  action.detail += (action.detail.empty() ? "" : ": ") + std::string(reason.text(0));
  return check_link(connection_, Fact::action_reason, action.id);
}

Result<std::vector<HistoryEntry>> Store::run_actions(std::int64_t run) {
  MDOF_TRY(Statement rows,
           connection_.prepare("WITH RECURSIVE chain (id) AS (SELECT ?1 UNION SELECT supersedes "
                               "FROM run JOIN chain USING (id) WHERE supersedes IS NOT NULL) " +
                               std::string(kActions) +
                               "WHERE subject = 'run' AND row IN (SELECT id FROM chain) "
                               "ORDER BY id"));
  rows.bind(run);
  return read_actions(rows);
}

Result<std::vector<HistoryEntry>> Store::list_actions(std::int64_t offset, std::int64_t count) {
  MDOF_TRY(Statement rows,
           connection_.prepare(std::string(kActions) + "ORDER BY id DESC LIMIT ?2 OFFSET ?1"));
  rows.bind(offset).bind(count);
  return read_actions(rows);
}

Result<std::int64_t> Store::count_actions() {
  return connection_.integer("SELECT count(*) FROM deed");
}

}  // namespace mdof::store
