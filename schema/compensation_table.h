// A one-axis compensation table: the measured errors against position, forward and reverse apart.
#pragma once

#include <array>
#include <cmath>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "schema/axis.h"
#include "schema/rig/chain.h"
#include "schema/rig/reference.h"
#include "schema/uncertainty/covers.h"

namespace mdof {

// The error of an axis along itself (EXX, EYY, EZZ), which the five probes do not see, by position;
// m. Of the axis' actual minus its commanded place in the controller's own coordinates, so that the
// correction is -E whichever body moves. NaN: no value there.
struct PositioningErrors {
  std::vector<double> forward, reverse, u_forward, u_reverse;
  std::vector<double> u_declared;  // empty: not declared
};

// Sense: the table holds errors (actual - nominal) of the body that moves. What a controller adds
// to the command of an axis follows from the machine's chain (schema/rig/correction.h), and without
// one is not known; every reply and export states which of the two it shows.
struct CompensationTable {
  std::int64_t id = 0;  // 0 until stored
  Axis axis = Axis::x;
  bool simulated = false;          // built from simulated data, wholly or in part
  bool slope_removed = true;       // straightness is about its least-squares line
  Sides sides;                     // of the rig that measured
  StatedAt stated;                 // straightness holds at this point
  Chain machine;                   // may be not known
  std::vector<std::int64_t> runs;  // built from
  std::vector<double> position_m;  // strictly increasing
  // [named error in the order of error_names()][position]; NaN: no value there
  std::array<std::vector<double>, 5> forward, reverse;
  // Standard uncertainty by noise and repeatability.
  std::array<std::vector<double>, 5> u_forward, u_reverse;
  // By what the rigs declare: common to both approaches, the larger of the two. Empty: they declare
  // nothing, or the table is older than this.
  std::array<std::vector<double>, 5> u_declared;
  // Of each interval, for u between its targets (algo/compensation/between_targets.h). Not stored:
  // they follow from the values; empty until they are made.
  std::array<std::vector<double>, 5> curvature_forward, curvature_reverse;
  PositioningErrors positioning;  // empty: not measured. Of imported runs
  // Built when tables did not say at which point they hold (at the carriage, in fact), nor which
  // way a correction goes: not to be served.
  bool without_stated_point = false;
  // Keys that the rigs of its runs leave open: u is too small by what they would add. Not stored:
  // the runs' rigs give.
  std::vector<std::string> not_declared;
  // No target was visited twice from the same side: u has no repeatability. Not stored: the runs'
  // points give.
  bool visited_once = false;
  std::string created_utc;
  std::string sha256;  // table_sha256(), or a value of before it; the ledger of the store checks it

  bool has_declared() const { return !u_declared.front().empty(); }
  bool has_positioning() const { return !positioning.forward.empty(); }
  // As of is_noise_only(Budget) of schema/uncertainty/budget.h, of all its values.
  bool noise_only() const;
  // Combined standard uncertainty of a named error at a position, of an approach.
  double u_of(const std::array<std::vector<double>, 5>& u_random, std::size_t named,
              std::size_t row) const {
    return has_declared() ? std::hypot(u_random[named][row], u_declared[named][row])
                          : u_random[named][row];
  }
  // The same of positioning. One reading a target shows no repeatability: its u is what was
  // declared.
  double u_of_positioning(bool of_forward, std::size_t row) const {
    const double value = (of_forward ? positioning.forward : positioning.reverse)[row];
    const double u_random = (of_forward ? positioning.u_forward : positioning.u_reverse)[row];
    if (!has_declared() || std::isnan(value)) return u_random;
    return std::hypot(std::isnan(u_random) ? 0 : u_random, positioning.u_declared[row]);
  }
};

// SHA-256 of what the table says, whatever words show it. Bytes hashed (i, d, s:
// schema/base/canonical.h):
//   s "mdof table 2", s axis, i simulated, i slope_removed, i number of runs, i each run,
//   s moves, s travel, s chain, s travels of the chain ("" "": not known), s reference, d
//   point_m[3], i n, d position_m[n], then in the order of the members i n, d each series:
//   forward[5], reverse[5], u_forward[5], u_reverse[5], u_declared[5], and of positioning forward,
//   reverse, u_forward, u_reverse, u_declared; n = 0 for one that the table has not.
// Tables of versions before have the hash of their JSON at that time.
std::string table_sha256(const CompensationTable& table);

// What its u covers.
Covers covers(const CompensationTable& table);
// Names the keys that this rig of one of its runs leaves open.
void add_not_declared(CompensationTable& table, const std::vector<std::string>& keys);

}  // namespace mdof
