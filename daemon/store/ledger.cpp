#include "daemon/store/ledger.h"

#include <array>
#include <optional>
#include <span>
#include <string_view>
#include <utility>

#include "schema/base/sha256.h"

namespace mdof::store {

using sqlite::Connection;
using sqlite::Statement;

namespace {

struct FactKind {
  Fact fact;
  const char* name;  // name of the fact in the ledger, and name of the database table
  const char* key;
  const char* called;  // name of the fact in messages
  const char* values;
};

constexpr std::array<FactKind, 11> kKinds = {{
    {Fact::run, "run", "id", "run",
     "SELECT run.axis, run.started_utc || CASE run.start_known WHEN 1 THEN ' known' WHEN 0 THEN "
     "' assumed' ELSE '' END, run.simulated, run.note, run.model, run.supersedes, "
     "recording.kind, recording.path, recording.sha256, rig.text, options.text, "
     "configuration.text, run.software_version, run.moves, run.travel, run.reference "
     "FROM run JOIN recording ON recording.id = run.recording JOIN document AS rig ON rig.id = "
     "run.rig JOIN document AS options ON options.id = run.options JOIN document AS configuration "
     "ON configuration.id = run.configuration WHERE run.id = ?"},
    {Fact::run_end, "run_end", "run", "end of run",
     "SELECT e.state, e.scans, e.scans_lost, e.warnings, e.result_sha256, recording.kind, "
     "recording.path, recording.sha256, t.mean_C, t.min_C, t.max_C, p.json "
     "FROM run_end AS e LEFT JOIN recording ON recording.id = e.recording "
     "LEFT JOIN run_temperature AS t ON t.run = e.run LEFT JOIN run_plausibility AS p "
     "ON p.run = e.run WHERE e.run = ?"},
    {Fact::squareness, "squareness", "id", "squareness",
     "SELECT run_x, run_y, EC0Y_rad, u_EC0Y_rad, slope_EYX_rad, u_slope_EYX_rad, slope_EXY_rad, "
     "u_slope_EXY_rad, artefact_angle_error_rad, form_rad, u_artefact_rad, artefact_corner, "
     "simulated, created_utc, reference FROM squareness WHERE id = ?"},
    {Fact::table, "compensation_table", "id", "compensation table",
     "SELECT axis, simulated, slope_removed, created_utc || coalesce(' added to ' || added_to, "
     "''), "
     "sha256, position_m, errors_m_rad, moves, "
     "travel, reference, point_m, chain, chain_travel, (SELECT group_concat(run) FROM (SELECT run "
     "FROM compensation_source AS s WHERE s.compensation_table = ?1 ORDER BY s.row)) "
     "FROM compensation_table WHERE id = ?1"},
    {Fact::activation, "activation", "generation", "activation of a table with the generation",
     "SELECT axis, compensation_table, actor, activated_utc FROM activation NOT INDEXED "
     "WHERE generation = ?"},
    {Fact::deactivation, "deactivation", "generation",
     "deactivation of a table with the generation",
     "SELECT axis, actor, deactivated_utc FROM deactivation NOT INDEXED WHERE generation = ?"},
    {Fact::action, "deed", "id", "action",
     "SELECT name, subject, row, uid, gid, pid, user, utc FROM deed NOT INDEXED WHERE id = ?"},
    {Fact::encoder_datum, "encoder_datum", "id", "encoder datum",
     "SELECT axis, device, before_m, position_m, offset_m, utc FROM encoder_datum NOT INDEXED "
     "WHERE id = ?"},
    {Fact::volumetric_table, "volumetric_table", "id", "volumetric table",
     "SELECT machine, document.text, chain, chain_travel, simulated, noise_only, approach, tool_m, "
     "rotary_rad, X_m, Y_m, Z_m, correction_m, u_m, interpolation_m, place_left_m, turn_left_rad, "
     "not_measured, u_not_declared, beyond_tables, created_utc, v.sha256, (SELECT "
     "group_concat(run) FROM (SELECT run FROM volumetric_source AS s WHERE s.volumetric_table = "
     "?1 ORDER BY s.row)) FROM volumetric_table AS v JOIN document ON document.id = v.description "
     "WHERE v.id = ?1"},
    {Fact::volumetric_activation, "volumetric_activation", "generation",
     "activation or deactivation of a volumetric table with the generation",
     "SELECT volumetric_table, actor, activated_utc FROM volumetric_activation NOT INDEXED WHERE "
     "generation = ?"},
    {Fact::action_reason, "deed_reason", "deed", "reason of action",
     "SELECT text FROM deed_reason NOT INDEXED WHERE deed = ?"},
}};

// Number of kinds that existed when the ledger was introduced.
constexpr std::size_t kFirstKinds = 6;

const FactKind& kind_of(Fact fact) {
  return kKinds[static_cast<std::size_t>(fact)];
}

const FactKind* kind_named(std::string_view name) {
  for (const FactKind& kind : kKinds)
    if (name == kind.name) return &kind;
  return nullptr;
}

// Also appends the storage class of the value. Otherwise a text that was replaced by a BLOB with
// the same bytes would have the same hash, but queries for the text would not find the BLOB.
void append_value(const Statement& row, int column, std::string& to) {
  const char storage = row.storage_class(column);
  to += storage;
  if (storage == 'i') {
    to += std::to_string(row.integer(column)) + '\n';
  } else if (storage == 'd') {
    const double x = row.real(column);
    to.append(reinterpret_cast<const char*>(&x), sizeof x);
  } else if (storage != 'n') {
    const std::string_view bytes = row.bytes(column);
    to.append(std::to_string(bytes.size())).append("\n").append(bytes);
  }
}

// Calculates the hash of a link. nullopt: the fact does not exist.
Result<std::optional<std::string>> calculate_link(Connection& connection, std::string_view previous,
                                                  const FactKind& kind, std::int64_t row) {
  MDOF_TRY(Statement values, connection.prepare(kind.values));
  MDOF_TRY(const bool found, values.bind(row).step());
  if (!found) return std::optional<std::string>();
  std::string text(previous);
  text.append("\n").append(kind.name).append("\n").append(std::to_string(row)).append("\n");
  for (int i = 0; i < values.columns(); ++i) append_value(values, i, text);
  return std::optional(sha256_hex(text));
}

std::string finding(const FactKind& kind, std::int64_t row, const char* what) {
  return std::string(kind.called) + " " + std::to_string(row) + ": " + what +
         "; restore the database from a backup";
}

constexpr const char* kChanged = "was changed after it was stored (the hash differs)";
constexpr const char* kUnlinked = "was not stored by mdof (the hash is missing)";
constexpr const char* kGone = "is missing";

tl::unexpected<Error> damaged(const Connection& connection, const std::string& what) {
  return bad_input(connection.file().string() + ": " + what, Remedy::verify_database);
}

// Calls visit(kind, row, previous, sha256) for each link, in order. Adds missing links and unknown
// facts to `findings`.
template <class Visit>
Status for_each_link(Connection& connection, std::vector<std::string>& findings, Visit visit) {
  MDOF_TRY(Statement links, connection.prepare("SELECT id, fact, row, sha256 FROM ledger NOT "
                                               "INDEXED ORDER BY id"));
  std::string previous;
  for (std::int64_t id = 1;; ++id) {
    MDOF_TRY(const bool more, links.step());
    if (!more) return {};
    const FactKind* kind = kind_named(links.text(1));
    if (!kind || links.integer(0) != id) {
      findings.push_back("link " + std::to_string(id) +
                         " of the chain of hashes is damaged; restore the database from a backup");
      return {};
    }
    const std::string sha256(links.text(3));
    MDOF_CHECK(visit(*kind, links.integer(2), previous, sha256));
    previous = sha256;
  }
}

Result<std::int64_t> count(Connection& connection, const FactKind& kind) {
  return connection.integer(std::string("SELECT count(*) FROM ") + kind.name + " NOT INDEXED");
}

// Checks the facts of the kinds that `wanted` selects: each fact must have a link, and the hash of
// the link must be correct.
template <class Wanted>
Status check_all(Connection& connection, std::vector<std::string>& findings, Wanted wanted) {
  std::array<std::int64_t, kKinds.size()> linked{};
  MDOF_CHECK(for_each_link(connection, findings,
                           [&](const FactKind& kind, std::int64_t row, const std::string& previous,
                               const std::string& sha256) -> Status {
                             if (!wanted(kind.fact)) return {};
                             ++linked[static_cast<std::size_t>(kind.fact)];
                             MDOF_TRY(const auto actual,
                                      calculate_link(connection, previous, kind, row));
                             if (actual != sha256)
                               findings.push_back(finding(kind, row, actual ? kChanged : kGone));
                             return {};
                           }));
  for (const FactKind& kind : kKinds) {
    if (!wanted(kind.fact)) continue;
    MDOF_TRY(const std::int64_t stored, count(connection, kind));
    if (stored != linked[static_cast<std::size_t>(kind.fact)])
      findings.push_back("table " + std::string(kind.name) + " has " + std::to_string(stored) +
                         " rows, but the chain of hashes contains the hashes of " +
                         std::to_string(linked[static_cast<std::size_t>(kind.fact)]) +
                         " rows; restore the database from a backup");
  }
  return {};
}

}  // namespace

Status add_link(Connection& connection, Fact fact, std::int64_t row) {
  const FactKind& kind = kind_of(fact);
  MDOF_TRY(const ChainHead head, chain_head(connection));
  MDOF_TRY(const auto sha256, calculate_link(connection, head.sha256, kind, row));
  if (!sha256) return damaged(connection, finding(kind, row, kGone));
  MDOF_TRY(Statement insert,
           connection.prepare("INSERT INTO ledger (fact, row, sha256) VALUES (?, ?, ?)"));
  return insert.bind(std::string_view(kind.name)).bind(row).bind(std::string_view(*sha256)).run();
}

Result<ChainHead> chain_head(Connection& connection) {
  MDOF_TRY(Statement last,
           connection.prepare("SELECT id, sha256 FROM ledger ORDER BY id DESC LIMIT 1"));
  MDOF_TRY(const bool found, last.step());
  return found ? ChainHead{last.integer(0), std::string(last.text(1))} : ChainHead{};
}

Result<bool> has_link(Connection& connection, const ChainHead& head) {
  if (head.link == 0) return true;
  MDOF_TRY(Statement link,
           connection.prepare("SELECT 1 FROM ledger NOT INDEXED WHERE id = ? AND sha256 = ?"));
  return link.bind(head.link).bind(std::string_view(head.sha256)).step();
}

Result<bool> has_hash(Connection& connection, const std::string& sha256) {
  MDOF_TRY(Statement link, connection.prepare("SELECT 1 FROM ledger NOT INDEXED WHERE sha256 = ?"));
  return link.bind(std::string_view(sha256)).step();
}

Status link_old_facts(Connection& connection) {
  for (const FactKind& kind : std::span(kKinds).first(kFirstKinds)) {
    std::vector<std::int64_t> rows;
    {
      MDOF_TRY(Statement keys, connection.prepare(std::string("SELECT ") + kind.key + " FROM " +
                                                  kind.name + " ORDER BY 1"));
      for (;;) {
        MDOF_TRY(const bool more, keys.step());
        if (!more) break;
        rows.push_back(keys.integer(0));
      }
    }
    for (const std::int64_t row : rows) MDOF_CHECK(add_link(connection, kind.fact, row));
  }
  return {};
}

Status check_link(Connection& connection, Fact fact, std::int64_t row) {
  const FactKind& kind = kind_of(fact);
  MDOF_TRY(Statement link,
           connection.prepare("SELECT sha256, (SELECT sha256 FROM ledger AS before WHERE before.id "
                              "= ledger.id - 1) FROM ledger WHERE fact = ? AND row = ?"));
  MDOF_TRY(const bool found, link.bind(std::string_view(kind.name)).bind(row).step());
  if (!found) return damaged(connection, finding(kind, row, kUnlinked));
  MDOF_TRY(const auto actual, calculate_link(connection, link.text(1), kind, row));
  if (actual == link.text(0)) return {};
  return damaged(connection, finding(kind, row, actual ? kChanged : kGone));
}

Status check_activations(Connection& connection) {
  std::vector<std::string> findings;
  MDOF_CHECK(check_all(connection, findings, [](Fact fact) {
    return fact == Fact::activation || fact == Fact::deactivation ||
           fact == Fact::volumetric_activation;
  }));
  return findings.empty() ? Status() : damaged(connection, findings.front());
}

Status verify_ledger(Connection& connection, std::vector<std::string>& findings) {
  return check_all(connection, findings, [](Fact) { return true; });
}

}  // namespace mdof::store
