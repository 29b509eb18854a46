// The ledger: a chain of hashes over all facts on which results, tables and activations depend. A
// fact is a row of the database, such as a run or an activation. Only files of the store include
// this header.
//
// The hash of link n is the SHA-256 of this text:
//   hash of link n - 1 (nothing for n = 1) '\n' fact '\n' row '\n' values
// `fact` is the name of the kind, and `row` is the number of the row. `values` are the values of
// this row, and of the rows to which it refers (recording, rig and other texts, temperature,
// plausibility, runs of a table). Their order is the order of the query in ledger.cpp. Each value
// is written as
//   NULL:     n
//   integer:  i decimal '\n'
//   double:   d 8 bytes
//   text:     t length '\n' bytes
//   bytes:    b length '\n' bytes
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "schema/base/result.h"
#include "schema/base/sqlite/sqlite.h"

namespace mdof::store {

inline constexpr int kLedgerSchema = 8;  // number of the migration that creates the ledger

// The last link of the chain. `link`: number of the link; the first link has the number 1.
// `sha256`: hash of the link; it depends on all earlier links.
struct ChainHead {
  std::int64_t link = 0;  // 0: the chain has no links
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

// Adds a link for the fact. Call this function in the transaction that stores the fact.
Status add_link(sqlite::Connection& connection, Fact fact, std::int64_t row);
// Adds links for all facts of a database that had no ledger. Such a database has no facts of the
// kinds that were introduced later.
Status link_old_facts(sqlite::Connection& connection);

Result<ChainHead> chain_head(sqlite::Connection& connection);
// Whether the chain contains `head`, as its head or as an earlier link. If the chain contains
// `head`, the chain was neither cut nor recalculated.
Result<bool> has_link(sqlite::Connection& connection, const ChainHead& head);
Result<bool> has_hash(sqlite::Connection& connection, const std::string& sha256);

// Checks the link of a fact. Error (bad_input): the fact has changed or has no link.
Status check_link(sqlite::Connection& connection, Fact fact, std::int64_t row);
// Checks the links of all activations and deactivations. Error (bad_input): one of them has
// changed, is missing or has no link.
Status check_activations(sqlite::Connection& connection);
// Checks the whole chain, and that the chain contains every fact. Adds one sentence to `findings`
// for each fault.
Status verify_ledger(sqlite::Connection& connection, std::vector<std::string>& findings);

}  // namespace mdof::store
