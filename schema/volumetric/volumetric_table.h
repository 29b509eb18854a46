// Compensation table over a plane or a volume: values that are added to the commands of the linear
// axes, so that the tool reaches the commanded position.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "schema/axis.h"
#include "schema/notice/notice.h"
#include "schema/rig/chain.h"
#include "schema/uncertainty/noise_only.h"

namespace mdof {

// Noise of the tables of one axis at one of its nodes. For each component X, Y, Z of the
// correction, m²: the variance at the node, and the covariance with the next node of the axis, each
// as c0 + c1 p + c2 q + c3 p² + c4 p q + c5 q² of the commands p, q (m) of the other two axes in
// the order X, Y, Z.
struct AxisNoise {
  using SquareForm = std::array<double, 6>;
  std::array<SquareForm, 3> variance{}, covariance_with_next{};
  bool operator==(const AxisNoise&) const = default;
};

// The nodes of the grid are all combinations of the commands, X fastest, then Y, then Z. An axis
// with one command is fixed there: a plane has one such axis, also if the machine has no such axis.
struct VolumetricTable {
  std::int64_t id = 0;  // 0 until stored; never equal to the id of a table of an axis
  std::string name;     // of the machine
  Chain machine;
  std::string description;         // text of MACHINE.toml
  std::vector<std::int64_t> runs;  // runs whose errors the table corrects
  bool simulated = false;          // wholly or partly
  // Of the errors; `some` in an older table may also mean all.
  NoiseOnly noise_only = NoiseOnly::none;
  std::string approach = "mean";  // of all axes: "mean", "forward", "reverse"
  Vec3 tool_m{};                  // point of the tool in machine coordinates, all axes at 0
  std::array<std::vector<double>, 3> command_m;  // X, Y, Z; each strictly increasing
  Vec3 rotary_rad{};                             // positions of A, B, C

  // By node: correction added to the commands of X, Y, Z, m; standard uncertainty of the tool's
  // position along X, Y, Z of the work, m (NaN: no error with an effect has a declared
  // uncertainty).
  std::vector<Vec3> correction_m, u_m;
  // The part of u_m from the noise of the tables of the grid's axes. It is independent between
  // positions of an axis; nodes with the same command of an axis share that axis' part. Empty: the
  // table is older than this member, or nothing is declared.
  std::vector<Vec3> u_independent_m;
  // The same by axis and its commands; empty for an axis with one command. All empty: as above.
  std::array<std::vector<AxisNoise>, 3> noise;
  // Largest difference between the linear interpolation between nodes and the correction of the
  // model, found at the centres of cells, faces and edges; m, by axis.
  Vec3 interpolation_m{};
  // Largest part of a correction that remains at a node because the errors depend on the approach
  // and the table has one value: half the difference for the approach "mean", the whole difference
  // for one approach. Each machine axis may arrive from either side. m, by axis; 0 in a table older
  // than this member.
  Vec3 reversal_m{};
  // Largest remaining errors with the corrected commands: the position error (m) that the linear
  // axes cannot correct, and the rotation of the tool (rad), which they cannot change.
  double place_left_m = 0, turn_left_rad = 0;
  // Names of errors: not measured and therefore not corrected; without u; with a table that ends
  // within the grid.
  std::vector<std::string> not_measured, u_not_declared, beyond_tables;
  // Notices of the errors that the table was built from; empty also in a table older than this
  // member.
  Notices doubtful;
  std::string created_utc;
  std::string sha256;  // volumetric_sha256()

  std::size_t nodes() const {
    return command_m[0].size() * command_m[1].size() * command_m[2].size();
  }
  std::size_t node(std::size_t x, std::size_t y, std::size_t z) const {
    return x + command_m[0].size() * (y + command_m[1].size() * z);
  }
  Vec3 command_at(std::size_t node) const;
  // Two parts of u: u_independent_m, and the part that is common to all nodes (squareness, declared
  // uncertainties, u of files). NaN: the parts are not known separately.
  Vec3 u_independent_at(std::size_t node) const;
  Vec3 u_common_at(std::size_t node) const;
};

// Positions of the rotary axes, as "A = 0 deg, C = 30 deg"; "": the machine has none. The table is
// valid only there.
std::string rotary_text(const VolumetricTable& table);

// The other part of u, if `part_m` is one part; m. NaN if either is NaN.
Vec3 remaining_u(const Vec3& u_m, const Vec3& part_m);

// All numbers of `noise`, X first: the variances of a node, then its covariances. set_noise()
// assigns them to the commands of the table; false: the number of values does not fit.
std::vector<double> noise_numbers(const VolumetricTable& table);
bool set_noise(VolumetricTable& table, const std::vector<double>& numbers);

// SHA-256 of the contents of the table. Bytes hashed (schema/base/canonical.h):
//   s "mdof volumetric table 1" (2 with u_independent_m, 3 with noise), s name, s chain, s travels,
//   s description, i number of runs, i each run, i simulated, i noise_only (0: none, 1: some, 2:
//   all), s approach, d tool_m[3], d rotary_rad[3], then for X, Y, Z i n, d command_m[n], d
//   correction_m[nodes][3], d u_m[nodes][3], d u_independent_m[nodes][3] (2, 3), d noise (3;
//   noise_numbers()), d interpolation_m[3], d place_left_m, d turn_left_rad, then for not_measured,
//   u_not_declared, beyond_tables i n, s each. If reversal_m is not 0, ", reversal" is appended to
//   the first s and d reversal_m[3] follows; if there are doubtful notices, ", doubtful" is
//   appended to the first s and s notices_json() is the last value.
std::string volumetric_sha256(const VolumetricTable& table);

// Contributions that u includes: one sentence for people, without a full stop.
std::string covers_text(const VolumetricTable& table);

}  // namespace mdof
