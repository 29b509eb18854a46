// Converts compensation tables to files of machine controllers, and reads these files. All
// functions are pure: they use texts instead of files.
//
// Input: tables of axes, a volumetric table, or the squareness of X and Y.
//
// Sign: a table contains errors E = actual - nominal of the moving body. The correction of an axis
// command is factor * E. For the positioning error the factor is always -1. For other errors the
// factor follows from the chain of the machine (schema/rig/correction.h). A file contains either
// the correction or the error. For each controller, formats.cpp states which of the two the file
// contains, and the source of this information.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "algo/compensation/residual_limits.h"
#include "schema/base/result.h"
#include "schema/compensation_table.h"
#include "schema/rig/chain.h"
#include "schema/uncertainty/budget.h"
#include "schema/volumetric/volumetric_table.h"

namespace mdof::controllers {

// One error of one axis as a function of the position of this axis.
struct Series {
  std::string error;   // "EXX"
  char along = 'X';    // axis whose positions are in position_m
  char command = 'X';  // axis whose command gets the correction
  bool angle = false;
  int factor = 0;                                    // correction = factor * E; 0: unknown
  std::string gap;                                   // why `factor` is unknown
  std::vector<double> position_m, forward, reverse;  // forward, reverse: E in m or rad
};

struct ExportOptions {
  // Largest permitted interpolation error from omitted points, m or rad; 0: keep all points.
  double tolerance_m = 0;
  // Write one value for both approaches, although the reversal error remains.
  bool one_approach = false;
  // If values are missing, export the longest range without missing values instead of returning an
  // error.
  bool cut_range = false;
  // The position at which the correction of an axis (mean of both approaches) becomes 0, because a
  // constant is subtracted. `axis` is 0 if the user stated a position without an axis; the position
  // then belongs to the only exported axis. Nothing is subtracted for an axis without an element in
  // `homes`.
  struct Home {
    char axis = 0;
    double at_m = 0;
  };
  std::vector<Home> homes;
  std::optional<double> home_m(char axis) const {
    for (const Home& home : homes)
      if (home.axis == axis) return home.at_m;
    return {};
  }
  // Limits of the residual in the self-test.
  // - residual_m: the residual may be at most residual_m + tolerance_m (rad for angles).
  // - residual_share: the residual may be at most this share of the error without correction. If
  //   this part of the error is less than the resolution of the numbers in the file, the resolution
  //   is the limit.
  double residual_m = algo::ResidualLimits{}.most_m;
  double residual_share = algo::ResidualLimits{}.share;
  // LinuxCNC only. `joints`: the joints that get the table of an axis; a gantry axis has two.
  // Empty: joints 0, 1, 2 are X, Y, Z. `inch`: the file is in inches instead of mm.
  struct Joint {
    char axis = 'X';
    int number = 0;
  };
  std::vector<Joint> joints;
  bool inch = false;
  // Home position and soft limits of a joint in the ini file of LinuxCNC, for notes.
  struct Travel {
    char axis = 'X';
    double home_m = 0;
    std::optional<double> from_m, to_m;
  };
  std::vector<Travel> travels;
  // LinuxCNC only: MAX_ACCELERATION and SERVO_PERIOD of a joint that gets the table of `axis`.
  struct Ramp {
    char axis = 'X';
    double max_acceleration_m_s2 = 0, period_s = 1e-3;
  };
  std::vector<Ramp> ramps;  // an axis without an element: its ramp is unknown
  // Siemens only: largest number of points in a table, and of tables, in this control. 0: the
  // default, 200 points, or no limit for the number of tables.
  std::size_t siemens_points = 0, siemens_tables = 0;
  std::vector<std::string> marks;  // warnings that are written into the files as comments
};

struct ControllerFile {
  std::string name, text;
};

// The number of points in the file for one error, and the effect of omitting points.
struct Written {
  std::string error;
  std::size_t points = 0, points_before = 0;
  double largest_deviation = 0;  // largest change of the error by omitted points, m or rad
};

struct Export {
  std::vector<ControllerFile> files;
  std::vector<Written> written;
  std::vector<std::string> left_out;  // errors that the controller cannot store
  std::vector<std::string> notes;
  // Volumetric table: largest residual at a node (the correction minus what the format represents).
  double left_m = 0;
};

// The correction that the controller adds to a command. The controller interpolates linearly
// between the positions, uses the end values beyond the ends, and selects `forward` or `reverse` by
// the sign of the velocity.
struct AppliedCorrection {
  std::string error;
  char along = 'X', command = 'X';
  std::vector<double> position_m, forward, reverse;  // correction, m or rad
};

// The angle between X and Y, and the chain of the machine.
struct SquareAxes {
  std::int64_t id = 0;  // id of the stored squareness
  double EC0Y_rad = 0;
  Budget budget;  // budget of EC0Y
  Chain machine;
  StatedAt at = kAtFixture;  // reference point of the angle
};

// `write` makes the files. `read` returns the corrections that the controller applies with these
// files; it accepts only the exact syntax of the files, and its errors name file and line. Both are
// nullptr if the controller does not support tables of axes.
struct AxisFiles {
  Result<Export> (*write)(const std::vector<CompensationTable>& tables,
                          const ExportOptions& options) = nullptr;
  Result<std::vector<AppliedCorrection>> (*read)(const std::vector<ControllerFile>& files) =
      nullptr;
};
struct VolumeFiles {
  Result<Export> (*write)(const VolumetricTable& table, const ExportOptions& options) = nullptr;
  // Returns only the grid and the corrections at its nodes, because the files contain no other data
  // of a table. The controller interpolates linearly between the nodes.
  Result<VolumetricTable> (*read)(const std::vector<ControllerFile>& files) = nullptr;
};
struct SquareFiles {
  Result<Export> (*write)(const SquareAxes& axes, const ExportOptions& options) = nullptr;
  // Returns k: for the commands x and y the controller moves X to x + k y.
  Result<double> (*read)(const std::vector<ControllerFile>& files) = nullptr;
};

struct Format {
  const char* name;   // "linuxcnc"
  const char* of;     // name of the controller
  const char* holds;  // the content of a table that the format can store
  const char* limits;
  const char* sense;   // what the values in the file are, and their sign
  const char* source;  // source of this meaning
  // Whether the sign in `sense` is confirmed; if not, the user must allow the export explicitly.
  bool sign_confirmed;
  double quantum_m;  // resolution of the numbers in the file, m; rad for a squareness
  bool takes_home;   // subtracts the correction at ExportOptions::home_m
  AxisFiles axes;    // A format supports axes, volume, square, or axes and volume.
  VolumeFiles volume;
  SquareFiles square;
  bool takes_joints = false;     // supports ExportOptions::joints, inch and ramps
  bool both_approaches = false;  // the file has one value for each approach, and therefore also
                                 // corrects the reversal error
};

// All formats, in the order in which the help lists them.
const std::vector<Format>& formats();
// Controllers for which mdof writes no files: the reason, and what the user can do instead.
struct UnsupportedController {
  const char *name, *of, *reason, *instead;
};
const std::vector<UnsupportedController>& not_written();
// Error (usage): lists the formats; for a controller in not_written() the message states the
// reason.
Result<const Format*> format_named(const std::string& name);

}  // namespace mdof::controllers
