// Functions of Store that check the integrity of the database.
#include <cctype>
#include <map>

#include "daemon/store/file/announced_head.h"
#include "daemon/store/file/migrate.h"
#include "daemon/store/ledger.h"
#include "daemon/store/store.h"
#include "schema/base/sha256.h"
#include "schema/sql/sql.h"

namespace mdof::store {

using sqlite::Connection;
using sqlite::Statement;

namespace {

// Removes comments and white space, because they can differ between versions of mdof.
std::string without_comments(std::string_view sql) {
  std::string text;
  for (std::size_t i = 0; i < sql.size(); ++i) {
    if (sql.substr(i, 2) == "--") i = std::min(sql.find('\n', i), sql.size());
    if (i < sql.size() && !std::isspace(static_cast<unsigned char>(sql[i]))) text += sql[i];
  }
  return text;
}

using Definitions = std::map<std::string, std::string>;  // ["view mdof_run"]: the SQL

Result<Definitions> definitions_of(Connection& connection) {
  MDOF_TRY(Statement rows, connection.prepare("SELECT type || ' ' || name, sql FROM sqlite_schema "
                                              "WHERE name NOT LIKE 'sqlite~_%' ESCAPE '~'"));
  Definitions all;
  for (;;) {
    MDOF_TRY(const bool row, rows.step());
    if (!row) return all;
    all[std::string(rows.text(0))] = without_comments(rows.text(1));
  }
}

}  // namespace

Result<std::vector<std::string>> Store::verify_definitions() {
  MDOF_TRY(Connection fresh, Connection::open(":memory:", sqlite::OpenMode::create));
  MDOF_CHECK(migrate(fresh, sql::migrations()));
  MDOF_TRY(const Definitions right, definitions_of(fresh));
  MDOF_TRY(const Definitions now, definitions_of(connection_));
  std::vector<std::string> findings;
  const char* const remedy = "; restore the database from a backup";
  for (const auto& [name, sql] : right) {
    const auto found = now.find(name);
    if (found == now.end())
      findings.push_back("the " + name + " is missing" + remedy);
    else if (found->second != sql)
      findings.push_back("the definition of the " + name + " was changed" + remedy);
  }
  for (const auto& [name, sql] : now)
    if (name.starts_with("trigger ") && !right.contains(name))
      findings.push_back("the " + name + " was added, and is not a part of mdof" + remedy);
  return findings;
}

Result<std::vector<std::string>> Store::verify() {
  std::vector<std::string> findings;
  for (const auto check : {&Store::verify_file, &Store::verify_ledger, &Store::verify_documents,
                           &Store::verify_runs, &Store::verify_studies}) {
    const Status done = (this->*check)(findings);
    if (done) continue;
    if (done.error().code != ErrorCode::bad_input) return tl::unexpected(done.error());
    findings.push_back(done.error().message);  // this damage prevents further reading
  }
  return findings;
}

Status Store::verify_ledger(std::vector<std::string>& findings) {
  MDOF_CHECK(store::verify_ledger(connection_, findings));
  if (findings.empty()) {
    // Some columns of a volumetric table are not in the ledger. Only the hash of the table protects
    // these columns.
    MDOF_TRY(const auto ids, integers("SELECT id FROM volumetric_table WHERE ? = 0", 0));
    for (const std::int64_t id : ids) {
      const auto table = volumetric(id);
      if (table) continue;
      if (table.error().code != ErrorCode::bad_input) return tl::unexpected(table.error());
      findings.push_back(table.error().message);
    }
  }
  return check_announced_head();
}

Status Store::check_announced_head() {
  return check_head(read_announced_head(file()).head);
}

Status Store::check_head(const ChainHead& reported) {
  MDOF_TRY(const bool found, store::has_link(connection_, reported));
  if (found) return {};
  MDOF_TRY(const ChainHead now, chain_head());
  return bad_input(file().string() + ": mdofd last reported link " + std::to_string(reported.link) +
                   " of the chain of hashes with hash " + reported.sha256 +
                   ", but the chain does not contain this link. The chain ends at link " +
                   std::to_string(now.link) +
                   ", so the newest entries are missing or were changed. Restore the database from "
                   "a backup. Or, to continue with this database, remove " +
                   announced_head_file(file()).string());
}

Status Store::verify_file(std::vector<std::string>& findings) {
  {
    MDOF_TRY(Statement rows, connection_.prepare("PRAGMA integrity_check"));
    for (;;) {
      MDOF_TRY(const bool row, rows.step());
      if (!row) break;
      if (rows.text(0) != "ok") findings.push_back("integrity: " + std::string(rows.text(0)));
    }
  }
  MDOF_TRY(Statement rows, connection_.prepare("PRAGMA foreign_key_check"));
  for (;;) {
    MDOF_TRY(const bool row, rows.step());
    if (!row) return {};
    findings.push_back("table " + std::string(rows.text(0)) + ": row " + std::string(rows.text(1)) +
                       " refers to a row of " + std::string(rows.text(2)) +
                       " that is missing; restore the database from a backup");
  }
}

Status Store::verify_documents(std::vector<std::string>& findings) {
  MDOF_TRY(Statement rows, connection_.prepare("SELECT id, sha256, text FROM document"));
  for (;;) {
    MDOF_TRY(const bool row, rows.step());
    if (!row) return {};
    if (sha256_hex(rows.text(2)) != rows.text(1))
      findings.push_back("document " + std::to_string(rows.integer(0)) +
                         " (a rig, a plan, options or a configuration) was changed after it was "
                         "stored; restore the database from a backup");
  }
}

Status Store::verify_runs(std::vector<std::string>& findings) {
  MDOF_TRY(Statement rows, connection_.prepare("SELECT run, result_sha256 FROM run_end"));
  for (;;) {
    MDOF_TRY(const bool row, rows.step());
    if (!row) return {};
    const std::int64_t run = rows.integer(0);
    const auto sha256 = result_sha256(run);
    if (!sha256) {
      if (sha256.error().code != ErrorCode::bad_input) return tl::unexpected(sha256.error());
      findings.push_back("the results of run " + std::to_string(run) +
                         " cannot be read: " + sha256.error().message);
    } else if (*sha256 != rows.text(1))
      findings.push_back("the results of run " + std::to_string(run) +
                         " were changed after they were stored; replay the recording of this run");
  }
}

}  // namespace mdof::store
