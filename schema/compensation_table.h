// Compensation table of one axis: measured errors against position, forward and reverse separately.
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

// Positioning errors of an axis (EXX, EYY, EZZ) by position, m. The five probes do not measure
// them. Error = actual minus commanded position in the coordinates of the controller, so the
// correction is -E, whichever body moves. NaN: no value.
struct PositioningErrors {
  std::vector<double> forward, reverse, u_forward, u_reverse;
  std::vector<double> u_declared;  // empty: not declared
};

// The table holds errors (actual - nominal) of the moving body. The correction that a controller
// adds to the command of an axis follows from the machine's chain (schema/rig/correction.h);
// without a chain it is unknown. Every reply and export states whether it shows errors or
// corrections.
struct CompensationTable {
  std::int64_t id = 0;  // 0 until stored
  Axis axis = Axis::x;
  bool simulated = false;          // built wholly or partly from simulated data
  bool slope_removed = true;       // straightness refers to its least-squares line
  Sides sides;                     // of the rig that measured the runs
  StatedAt stated;                 // reference point of straightness
  Chain machine;                   // may be unknown
  std::vector<std::int64_t> runs;  // ids of the runs that it was built from
  std::vector<double> position_m;  // strictly increasing
  // [named error in the order of error_names()][position]; NaN: no value
  std::array<std::vector<double>, 5> forward, reverse;
  // Standard uncertainty from noise and repeatability.
  std::array<std::vector<double>, 5> u_forward, u_reverse;
  // Standard uncertainty from the declarations of the rigs: common to both approaches, the larger
  // of the two. Empty: the rigs declare nothing, or the table was built before u_declared existed.
  std::array<std::vector<double>, 5> u_declared;
  // Curvature of each interval, for u between targets (algo/compensation/between_targets.h). Not
  // stored: calculated from the values; empty until then.
  std::array<std::vector<double>, 5> curvature_forward, curvature_reverse;
  PositioningErrors positioning;  // empty: not measured; from imported runs only
  // Built by a version that stated no reference point (it was the carriage) and no direction of the
  // correction. Such a table must not be served.
  bool without_stated_point = false;
  // Keys that the rigs of the runs do not declare; u does not include their contributions. Not
  // stored: taken from the rigs of the runs.
  std::vector<std::string> not_declared;
  // No target was visited twice from the same side, so u contains no repeatability. Not stored:
  // found from the points of the runs.
  bool visited_once = false;
  std::string created_utc;
  std::string sha256;  // table_sha256() or a value of an earlier version; checked by the ledger of
                       // the store

  bool has_declared() const { return !u_declared.front().empty(); }
  bool has_positioning() const { return !positioning.forward.empty(); }
  // Applies is_noise_only() of schema/uncertainty/budget.h to all values.
  bool noise_only() const;
  // Combined standard uncertainty of a named error at a position, for one approach.
  double u_of(const std::array<std::vector<double>, 5>& u_random, std::size_t named,
              std::size_t row) const {
    return has_declared() ? std::hypot(u_random[named][row], u_declared[named][row])
                          : u_random[named][row];
  }
  // Combined standard uncertainty of positioning. With one reading per target, repeatability is
  // unknown and u is the declared uncertainty.
  double positioning_u_at(bool of_forward, std::size_t row) const {
    const double value = (of_forward ? positioning.forward : positioning.reverse)[row];
    const double u_random = (of_forward ? positioning.u_forward : positioning.u_reverse)[row];
    if (!has_declared() || std::isnan(value)) return u_random;
    return std::hypot(std::isnan(u_random) ? 0 : u_random, positioning.u_declared[row]);
  }
};

// SHA-256 of the contents of the table, independent of any text format. Bytes hashed (i, d, s:
// schema/base/canonical.h):
//   s "mdof table 2", s axis, i simulated, i slope_removed, i number of runs, i each run,
//   s moves, s travel, s chain, s travels of the chain ("" "": unknown), s reference, d point_m[3],
//   i n, d position_m[n], then in the order of the members i n, d each series: forward[5],
//   reverse[5], u_forward[5], u_reverse[5], u_declared[5], and the series of positioning: forward,
//   reverse, u_forward, u_reverse, u_declared; n = 0 for a series that the table does not have.
// Tables of earlier versions have the hash of the JSON that was written at that time.
std::string table_sha256(const CompensationTable& table);

// Uncertainty contributions that u includes.
Covers covers(const CompensationTable& table);
// Adds the keys that the rig of one run does not declare, each once.
void add_not_declared(CompensationTable& table, const std::vector<std::string>& keys);

}  // namespace mdof
