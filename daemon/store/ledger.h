// The chain of hashes over what results, tables and activations rest on. Private header of the
// store.
//
//   hash of link n = SHA-256 of  hash of link n-1 (nothing for n = 1) '\n' fact '\n' row '\n'
//   values
//
// `values` are those of the fact's row and of the rows that it refers to (recording, rig and other
// texts, temperature, plausibility, runs of a table), in the order of the query in ledger.cpp, each
// as
//   n: NULL; i decimal '\n': an integer; d 8 bytes: a double; t length '\n' bytes: text; b the
//   same: bytes
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "schema/base/result.h"
#include "schema/base/sqlite/sqlite.h"

namespace mdof::store {

inline constexpr int kLedgerSchema = 8;  // the migration that made it

// The last link of a chain: its number, from 1, and its hash, which depends on all before it.
struct ChainHead {
  std::int64_t link = 0;  // 0: none yet
  std::string sha256;
  bool operator==(const ChainHead&) const = default;
};

enum class Fact {
  run,
  run_end,
  squareness,
  table,
  activation,
  deactivation,
  action,
  encoder_datum,
  volumetric_table,
  volumetric_activation,
  action_reason,
};

// Within the transaction that stored the fact.
Status add_link(sqlite::Connection& connection, Fact fact, std::int64_t row);
// Links all facts of a database from before it had a ledger; of the later kinds there were none.
Status link_old_facts(sqlite::Connection& connection);

Result<ChainHead> chain_head(sqlite::Connection& connection);
// Whether it is still the head or a link on the way to it: nothing was cut off or calculated anew.
Result<bool> has_link(sqlite::Connection& connection, const ChainHead& head);
Result<bool> has_hash(sqlite::Connection& connection, const std::string& sha256);

// Error (bad_input): the fact is not what was stored, or has no link.
Status check_link(sqlite::Connection& connection, Fact fact, std::int64_t row);
// The same of every activation and deactivation, of axes and of the volume, and that none is
// missing.
Status check_activations(sqlite::Connection& connection);
// The whole chain, and that every fact is in it. One sentence a finding.
Status verify_ledger(sqlite::Connection& connection, std::vector<std::string>& findings);

}  // namespace mdof::store
