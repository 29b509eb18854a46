// A compensation table over a plane or a volume of a machine: what is added to the commands of its
// linear axes, so that the tool is where the commands should have brought it.
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

// The noise of the tables of one axis at one of its nodes. By component X, Y, Z of the correction,
// m²: its variance there, and its covariance with that at the axis' next node, each as c0 + c1 p +
// c2 q + c3 p² + c4 p q + c5 q² of the commands p, q (m) of the other two axes in the order X, Y,
// Z.
struct AxisNoise {
  using SquareForm = std::array<double, 6>;
  std::array<SquareForm, 3> variance{}, with_next{};
  bool operator==(const AxisNoise&) const = default;
};

// The nodes of the grid lie at all combinations of the commands, X fastest, then Y, then Z. An axis
// with one command stands there: a plane has one such axis, or a machine without it.
struct VolumetricTable {
  std::int64_t id = 0;  // 0 until stored; no table of an axis has the same
  std::string name;     // of the machine
  Chain machine;
  std::string description;                 // MACHINE.toml, as it was given
  std::vector<std::int64_t> runs;          // whose errors are in it
  bool simulated = false;                  // wholly or in part
  NoiseOnly noise_only = NoiseOnly::none;  // of the errors; of an older table some at least
  std::string approach = "mean";           // of all axes: "mean", "forward", "reverse"
  Vec3 tool_m{};                           // the tool's point, in the machine's coordinates at 0
  std::array<std::vector<double>, 3> command_m;  // X, Y, Z; each strictly increasing
  Vec3 rotary_rad{};                             // where A, B, C stand

  // By node: added to the commands of X, Y, Z, m; standard uncertainty of the tool's place along X,
  // Y, Z of the work, m (NaN: nothing that counts declares one).
  std::vector<Vec3> correction_m, u_m;
  // The part of u_m by noise of the tables of the grid's axes, which is independent from one
  // position of an axis to another: nodes with the same command of an axis have that axis' part in
  // common. Empty: the table is older than this, or nothing declares one.
  std::vector<Vec3> u_independent_m;
  // The same by axis and its commands; of an axis with one command: none. Empty: likewise.
  std::array<std::vector<AxisNoise>, 3> noise;
  // The largest that straight lines between nodes are off the correction of the model, found in the
  // middle of cells, faces and edges; m, by axis.
  Vec3 interpolation_m{};
  // The largest that the table leaves of a correction at a node because the errors differ by
  // approach and it has one value: of the mean half the difference, of one approach the whole; each
  // axis of the machine may come from either side. m, by axis; 0 of a table older than this.
  Vec3 reversal_m{};
  // The largest that stays with the corrected commands: of the place (m) what the linear axes
  // cannot reach, and the turn of the tool, which they cannot change (rad).
  double place_left_m = 0, turn_left_rad = 0;
  // Names of errors: not measured, so not corrected; without u; whose table ends within the grid.
  std::vector<std::string> not_measured, u_not_declared, beyond_tables;
  // Of the errors that it was built from; empty, too, of a table that is older than this.
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
  // The two parts: that one, and what its causes make common to all nodes, as squareness, what the
  // rigs declare and u of files. NaN: not known apart.
  Vec3 u_independent_at(std::size_t node) const;
  Vec3 u_common_at(std::size_t node) const;
};

// Where the rotary axes of the machine stand, as "A = 0 deg, C = 30 deg"; "": it has none. The
// table holds there only.
std::string rotary_text(const VolumetricTable& table);

// The part of u that is left beside another, m; NaN where one is.
Vec3 u_beside(const Vec3& u_m, const Vec3& part_m);

// All of `noise`, X first: the variances of a node, its covariances. set_noise() takes them for the
// commands of the table; false: not as many as these have.
std::vector<double> noise_numbers(const VolumetricTable& table);
bool set_noise(VolumetricTable& table, const std::vector<double>& numbers);

// SHA-256 of what the table says. Bytes hashed (schema/base/canonical.h):
//   s "mdof volumetric table 1" (2 with u_independent_m, 3 with noise), s name, s chain, s travels,
//   s description, i number of runs, i each run, i simulated, i noise_only (0: none, 1: some, 2:
//   all), s approach, d tool_m[3], d rotary_rad[3], then of X, Y, Z i n, d command_m[n], d
//   correction_m[nodes][3], d u_m[nodes][3], d u_independent_m[nodes][3] (2, 3), d noise (3;
//   noise_numbers()), d interpolation_m[3], d place_left_m, d turn_left_rad, then of not_measured,
//   u_not_declared, beyond_tables i n, s each. Where reversal_m is not 0, the first s goes on with
//   ", reversal", and d reversal_m[3] follows; where there are doubtful notices, with ", doubtful",
//   and s notices_json() ends all.
std::string volumetric_sha256(const VolumetricTable& table);

// What its u covers: one sentence for people, without a full stop.
std::string covers_text(const VolumetricTable& table);

}  // namespace mdof
