// Functions of Store for axis positions that users set.
#include "daemon/store/ledger.h"
#include "daemon/store/store.h"

namespace mdof::store {

using sqlite::Statement;
using sqlite::Transaction;

namespace {

constexpr std::string_view kSettings =
    "SELECT id, axis, device, before_m, position_m, offset_m, utc FROM encoder_datum ";

}  // namespace

Result<std::int64_t> Store::add_datum(const DatumSetting& setting,
                                      const std::optional<HistoryEntry>& action) {
  MDOF_TRY(Transaction transaction, Transaction::begin(connection_));
  MDOF_TRY(Statement insert,
           connection_.prepare("INSERT INTO encoder_datum (axis, device, before_m, position_m, "
                               "offset_m, utc) VALUES (?, ?, ?, ?, ?, ?)"));
  const char axis = letter(setting.axis);
  insert.bind(std::string_view(&axis, 1)).bind(std::string_view(setting.device));
  insert.bind(setting.before_m).bind(setting.position_m).bind(setting.offset_m);
  insert.bind(std::string_view(setting.utc));
  MDOF_CHECK(insert.run());
  const std::int64_t id = connection_.last_insert_rowid();
  MDOF_CHECK(add_link(connection_, Fact::encoder_datum, id));
  MDOF_CHECK(insert_action("encoder_datum", id, action));
  MDOF_CHECK(transaction.commit());
  return id;
}

Result<std::optional<DatumSetting>> Store::read_datum(Statement& row) {
  MDOF_TRY(const bool found, row.step());
  if (!found) return std::optional<DatumSetting>();
  DatumSetting setting;
  setting.id = row.integer(0);
  setting.device = row.text(2);
  setting.before_m = row.real(3);
  setting.position_m = row.real(4);
  setting.offset_m = row.real(5);
  setting.utc = row.text(6);
  if (const auto axis = axis_from(row.text(1))) setting.axis = *axis;
  MDOF_CHECK(check_link(connection_, Fact::encoder_datum, setting.id));
  return std::optional(std::move(setting));
}

Result<std::optional<DatumSetting>> Store::datum(std::int64_t id) {
  MDOF_TRY(Statement row, connection_.prepare(std::string(kSettings) + "WHERE id = ?"));
  return read_datum(row.bind(id));
}

Result<std::optional<DatumSetting>> Store::last_datum(Axis axis) {
  MDOF_TRY(Statement row,
           connection_.prepare(std::string(kSettings) + "WHERE axis = ? ORDER BY id DESC LIMIT 1"));
  const char name = letter(axis);
  return read_datum(row.bind(std::string_view(&name, 1)));
}

}  // namespace mdof::store
