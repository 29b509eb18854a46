// Store: the history, who did what.
#include "daemon/store/ledger.h"
#include "daemon/store/store.h"

namespace mdof::store {

using sqlite::Statement;

namespace {

constexpr std::string_view kDeeds =
    "SELECT id, name, subject, row, uid, gid, pid, user, utc FROM deed ";

Deed deed_of(const Statement& row) {
  Deed deed;
  deed.id = row.integer(0);
  deed.name = row.text(1);
  deed.subject = row.text(2);
  deed.row = row.integer(3);
  deed.by = {row.integer(4), row.integer(5), row.integer(6), std::string(row.text(7))};
  deed.utc = row.text(8);
  return deed;
}

}  // namespace

Status Store::insert_deed(std::string_view subject, std::int64_t row,
                          const std::optional<Deed>& deed) {
  if (!deed) return {};
  MDOF_TRY(Statement insert,
           connection_.prepare("INSERT INTO deed (name, subject, row, uid, gid, pid, user, utc) "
                               "VALUES (?, ?, ?, ?, ?, ?, ?, ?)"));
  insert.bind(std::string_view(deed->name)).bind(subject).bind(row);
  insert.bind(deed->by.uid).bind(deed->by.gid).bind(deed->by.pid);
  insert.bind(std::string_view(deed->by.user)).bind(std::string_view(deed->utc));
  MDOF_CHECK(insert.run());
  return add_link(connection_, Fact::deed, connection_.last_insert_rowid());
}

Result<std::vector<Deed>> Store::read_deeds(Statement& rows) {
  std::vector<Deed> list;
  for (;;) {
    MDOF_TRY(const bool row, rows.step());
    if (!row) return list;
    list.push_back(deed_of(rows));
    MDOF_CHECK(check_link(connection_, Fact::deed, list.back().id));
    MDOF_CHECK(add_detail(list.back()));
  }
}

Status Store::add_detail(Deed& deed) {
  if (deed.subject != "encoder_datum") return {};
  MDOF_TRY(const auto setting, datum(deed.row));
  if (setting) deed.detail = setting_text(*setting);
  return {};
}

Result<std::vector<Deed>> Store::deeds_of_run(std::int64_t run) {
  MDOF_TRY(Statement rows,
           connection_.prepare("WITH RECURSIVE chain (id) AS (SELECT ?1 UNION SELECT supersedes "
                               "FROM run JOIN chain USING (id) WHERE supersedes IS NOT NULL) " +
                               std::string(kDeeds) +
                               "WHERE subject = 'run' AND row IN (SELECT id FROM chain) "
                               "ORDER BY id"));
  rows.bind(run);
  return read_deeds(rows);
}

Result<std::vector<Deed>> Store::list_deeds(std::int64_t offset, std::int64_t count) {
  MDOF_TRY(Statement rows,
           connection_.prepare(std::string(kDeeds) + "ORDER BY id DESC LIMIT ?2 OFFSET ?1"));
  rows.bind(offset).bind(count);
  return read_deeds(rows);
}

Result<std::int64_t> Store::count_deeds() {
  return connection_.integer("SELECT count(*) FROM deed");
}

}  // namespace mdof::store
