// The chain of hashes over all facts on which results, tables and activations depend. Private
// header of the store.
//
//   hash of link n = SHA-256 of  hash of link n-1 (nothing for n = 1) '\n' fact '\n' row '\n'
//   values
//
// `values` are the values of the fact's row and of the rows to which it refers (recording, rig and
// other texts, temperature, plausibility, runs of a table), in the order of the query in
// ledger.cpp, each as
//   n: NULL; i decimal '\n': an integer; d 8 bytes: a double; t length '\n' bytes: text; b length
//   '\n' bytes: bytes
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "schema/base/result.h"
#include "schema/base/sqlite/sqlite.h"

namespace mdof::store {

inline constexpr int kLedgerSchema = 8;  // the migration that created the ledger

// The last link of a chain: its number, from 1, and its hash, which depends on all earlier links.
struct ChainHead {
  std::int64_t link = 0;  // 0: no links
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

// Call it in the transaction that stored the fact.
Status add_link(sqlite::Connection& connection, Fact fact, std::int64_t row);
// Adds links for all facts of a database without a ledger; it has no facts of later kinds.
Status link_old_facts(sqlite::Connection& connection);

Result<ChainHead> chain_head(sqlite::Connection& connection);
// Whether `head` is the head or an earlier link, so that the chain was neither cut nor
// recalculated.
Result<bool> has_link(sqlite::Connection& connection, const ChainHead& head);
Result<bool> has_hash(sqlite::Connection& connection, const std::string& sha256);

// Error (bad_input): the fact has changed or has no link.
Status check_link(sqlite::Connection& connection, Fact fact, std::int64_t row);
// The same for every activation and deactivation of axes and volume; also checks that none is
// missing.
Status check_activations(sqlite::Connection& connection);
// Checks the whole chain, and that every fact is in it. One sentence for each finding.
Status verify_ledger(sqlite::Connection& connection, std::vector<std::string>& findings);

}  // namespace mdof::store
