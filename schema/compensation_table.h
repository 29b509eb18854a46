// Compensation table of one axis: measured errors as functions of the position, for each approach.
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
#include "schema/rig/rig.h"
#include "schema/uncertainty/covers.h"

namespace mdof {

// Positioning errors of an axis (EXX, EYY, EZZ) at the positions of the table, m. The five probes
// do not measure them. Error = actual minus commanded position in the coordinates of the
// controller. Therefore the correction is -E, for a moving target and for a moving fixture. NaN: no
// value.
struct PositioningErrors {
  std::vector<double> forward, reverse, u_forward, u_reverse;
  std::vector<double> u_declared;  // empty: no uncertainty is declared
};

// The table contains errors (actual - nominal) of the moving body. A controller adds a correction
// to the command of an axis. The sign of this correction follows from the kinematic chain of the
// machine (schema/rig/correction.h); without a chain the sign is unknown. Every reply and export
// states whether it contains errors or corrections.
struct CompensationTable {
  std::int64_t id = 0;  // 0: not stored yet
  Axis axis = Axis::x;
  bool simulated = false;          // true: all or some of the data are simulated
  bool slope_removed = true;       // true: straightness is relative to its least-squares line
  Sides sides;                     // sides of the rig that measured the runs
  StatedAt stated;                 // reference point of the straightness errors
  Chain machine;                   // may be unknown
  std::vector<std::int64_t> runs;  // ids of the runs from which the table was built
  // The table that the controller applied during the runs. Its values are in this table, too.
  // nullopt: this table contains only the errors of the runs.
  std::optional<std::int64_t> added_to;
  std::vector<double> position_m;  // strictly increasing
  // [error in the order of error_names()][position]; NaN: no value
  std::array<std::vector<double>, 5> forward, reverse;
  // Standard uncertainty from noise and repeatability.
  std::array<std::vector<double>, 5> u_forward, u_reverse;
  // Standard uncertainty from the declarations of the rigs and from the removal of drifts. It has
  // one value for both approaches: the larger one of their values. Empty: nothing is declared and
  // no drift was removed, or an mdof version without this member built the table.
  std::array<std::vector<double>, 5> u_declared;
  // Curvature of the error in each interval, for u between targets
  // (algo/compensation/between_targets.h). It is calculated from the values and not stored; empty
  // before the calculation.
  std::array<std::vector<double>, 5> curvature_forward, curvature_reverse;
  PositioningErrors positioning;  // from imported runs only; empty: not measured
  // True: the table was built by an old version that stated neither the reference point (which was
  // the carriage) nor the direction of the correction. Such a table must not be sent to a client or
  // controller.
  bool lacks_reference_point = false;
  // Keys that the rigs of the runs do not declare; u does not include the contributions of these
  // keys. They are read from the rigs and not stored.
  std::vector<std::string> not_declared;
  bool rigs_declare = false;  // whether a rig declares any uncertainty; not stored
  // True: no target was visited twice from the same side, so that u contains no repeatability. It
  // is found from the points of the runs and not stored.
  bool visited_once = false;
  std::string created_utc;
  // table_sha256(), or a value of an earlier version. The ledger of the store checks it.
  std::string sha256;

  bool has_declared() const { return !u_declared.front().empty(); }
  bool has_positioning() const { return !positioning.forward.empty(); }
  // True if is_noise_only() (schema/uncertainty/budget.h) is true for all values: u contains noise
  // only.
  bool noise_only() const;
  // Combined standard uncertainty of an error at a position, for one approach. `u_random`:
  // u_forward or u_reverse.
  double u_of(const std::array<std::vector<double>, 5>& u_random, std::size_t named,
              std::size_t row) const {
    return has_declared() ? std::hypot(u_random[named][row], u_declared[named][row])
                          : u_random[named][row];
  }
  // Combined standard uncertainty of the positioning error. If a target has only one reading, the
  // repeatability is unknown, and u is the declared uncertainty.
  double positioning_u_at(bool of_forward, std::size_t row) const {
    const double value = (of_forward ? positioning.forward : positioning.reverse)[row];
    const double u_random = (of_forward ? positioning.u_forward : positioning.u_reverse)[row];
    if (!has_declared() || std::isnan(value)) return u_random;
    return std::hypot(std::isnan(u_random) ? 0 : u_random, positioning.u_declared[row]);
  }
};

// SHA-256 of the contents of the table, independent of any text format. These bytes are hashed, in
// this order (i, d, s: schema/base/canonical.h):
//   s "mdof table 2", s axis
//   i simulated, i slope_removed
//   i number of runs, i each run
//   only if the table was added to another one: s "added to", i id of that table
//   s moves, s travel
//   s chain, s travels of the chain ("" "": unknown)
//   s reference, d point_m[3]
//   i n, d position_m[n]
//   for each of these series i n, d the n values (n = 0: the table does not have the series):
//     forward[5], reverse[5], u_forward[5], u_reverse[5], u_declared[5]
//     of positioning: forward, reverse, u_forward, u_reverse, u_declared
// A table that an earlier version of mdof stored has another hash: that of the JSON text that the
// earlier version wrote.
std::string table_sha256(const CompensationTable& table);

// The contributions that u of the table includes.
Covers covers(const CompensationTable& table);
// Sets rigs_declare if the rig of a run declares an uncertainty. Appends the keys that the rig does
// not declare; a key that the table already has is not repeated.
void add_declarations(CompensationTable& table, const Rig& rig);

}  // namespace mdof
