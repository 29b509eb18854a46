// Compensation table for a plane or a volume. Its values are added to the commands of the linear
// axes; the tool then reaches the commanded position.
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

// Effect of the noise of the compensation tables of one axis on the correction, at one node of this
// axis. There are two sets of numbers for each component X, Y, Z of the correction, in m²: the
// variance at the node, and the covariance with the next node of the axis. Each is a polynomial
//   c0 + c1 p + c2 q + c3 p² + c4 p q + c5 q²
// of the commands p and q (m) of the other two axes, in the order X, Y, Z.
struct AxisNoise {
  using SquareForm = std::array<double, 6>;
  std::array<SquareForm, 3> variance{}, covariance_with_next{};
  bool operator==(const AxisNoise&) const = default;
};

// The nodes of the grid are all combinations of the commands; X changes fastest, then Y, then Z. An
// axis with only one command is fixed at this command. A table for a plane has one such axis, even
// if the machine does not have this axis.
struct VolumetricTable {
  std::int64_t id = 0;  // 0: not stored yet; never equal to the id of a table of one axis
  std::string name;     // name of the machine
  Chain machine;
  std::string description;         // text of MACHINE.toml
  std::vector<std::int64_t> runs;  // runs whose errors the table corrects
  bool simulated = false;          // true: all or some of the data are simulated
  // Whether u of the errors contains noise only. In an older table, `some` may also mean `all`.
  NoiseOnly noise_only = NoiseOnly::none;
  std::string approach = "mean";  // approach for all axes: "mean", "forward", "reverse"
  Vec3 tool_m{};  // point of the tool, in machine coordinates, when all axes are at 0
  std::array<std::vector<double>, 3> command_m;  // X, Y, Z; each strictly increasing
  Vec3 rotary_rad{};                             // positions of A, B, C

  // For each node: the correction that is added to the commands of X, Y, Z, m; and the standard
  // uncertainty of the tool's position along X, Y, Z of the work, m. NaN: no error that affects
  // this position has a declared uncertainty.
  std::vector<Vec3> correction_m, u_m;
  // The part of u_m that comes from the noise of the tables of the grid's axes. This part is
  // independent between different positions of an axis; nodes with the same command of an axis have
  // the same contribution from this axis. Empty: nothing is declared, or an mdof version without
  // this member built the table.
  std::vector<Vec3> u_independent_m;
  // The same noise for each axis and each of its commands; empty for an axis with one command.
  // Empty for all axes: for the same reasons as u_independent_m.
  std::array<std::vector<AxisNoise>, 3> noise;
  // Largest difference between the linear interpolation between the nodes and the correction of the
  // model; m, for each axis. It is calculated at the centres of cells, faces and edges.
  Vec3 interpolation_m{};
  // The standard uncertainty that u of the correction has between two nodes in addition to
  // interpolated u, because the errors between their measured positions are not known. For each
  // axis with several commands, and each of its cells: the largest value inside the cell for all
  // nodes of the other axes; m, for each component X, Y, Z of the correction. NaN: u is unknown.
  // Empty for all axes: an mdof version without this member built the table.
  std::array<std::vector<Vec3>, 3> u_between_m;
  // The errors depend on the approach, but the table has only one value for each node. This is the
  // largest part of a correction that therefore remains at a node; m, for each axis. For the
  // approach "mean" it is half the difference between the approaches, for "forward" or "reverse"
  // the whole difference. Each machine axis may arrive from either side. 0 if an mdof version
  // without this member built the table.
  Vec3 reversal_m{};
  // Largest errors that remain with the corrected commands: the position error that the linear axes
  // cannot correct (m), and the rotation of the tool, which the linear axes cannot change (rad).
  double place_left_m = 0, turn_left_rad = 0;
  // Names of errors: errors that were not measured and are therefore not corrected; errors without
  // u; errors whose table ends inside the grid.
  std::vector<std::string> not_measured, u_not_declared, beyond_tables;
  // Notices of the errors from which the table was built. Empty if an mdof version without this
  // member built the table.
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
  // The two parts of u at a node: the independent part (u_independent_m), and the part that is
  // common to all nodes (squareness, declared uncertainties, u of files). NaN: the parts are not
  // known separately.
  Vec3 u_independent_at(std::size_t node) const;
  Vec3 u_common_at(std::size_t node) const;
  bool has_u_between() const;
};

// Text with the positions of the rotary axes: "A = 0 deg, C = 30 deg"; "": the machine has no
// rotary axes. The table is valid only at these positions.
std::string rotary_text(const VolumetricTable& table);

// Returns √(u_m² - part_m²), m: the second part of u_m if `part_m` is its first part. NaN if `u_m`
// or `part_m` is NaN.
Vec3 remaining_u(const Vec3& u_m, const Vec3& part_m);

// noise_numbers() returns all numbers of `noise`: X first; for each node the variances, then the
// covariances. set_noise() assigns such numbers to the commands of the table; it returns false if
// their number is wrong.
std::vector<double> noise_numbers(const VolumetricTable& table);
bool set_noise(VolumetricTable& table, const std::vector<double>& numbers);
// The same for the numbers of u_between_m: X first.
std::vector<double> u_between_numbers(const VolumetricTable& table);
bool set_u_between(VolumetricTable& table, const std::vector<double>& numbers);

// SHA-256 of the contents of the table. These bytes are hashed, in this order (i, d, s:
// schema/base/canonical.h):
//   s "mdof volumetric table N". N is 3 if the table has noise, 2 if it has only u_independent_m,
//     otherwise 1. ", reversal" is appended if reversal_m is not 0, then ", doubtful" if there are
//     doubtful notices, then ", between" if the table has u_between_m
//   s name, s chain, s travels, s description
//   i number of runs, i each run
//   i simulated, i noise_only (0: none, 1: some, 2: all), s approach
//   d tool_m[3], d rotary_rad[3]
//   for X, Y and Z: i n, d command_m[n]
//   d correction_m[nodes][3], d u_m[nodes][3], d u_independent_m[nodes][3] (N = 2, 3)
//   d noise_numbers() (N = 3)
//   d interpolation_m[3], d place_left_m, d turn_left_rad
//   for not_measured, u_not_declared and beyond_tables: i n, s each name
//   d reversal_m[3], if it is not 0
//   s notices_json() of the doubtful notices, if there are any
//   d u_between_numbers()
std::string volumetric_sha256(const VolumetricTable& table);

// Text for people, one sentence without a full stop: the contributions that u includes.
std::string covers_text(const VolumetricTable& table);

}  // namespace mdof
