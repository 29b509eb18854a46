// Converts compensation tables to files of machine controllers and back, by pure functions from
// values to texts.
//
// Input: tables of axes, a volumetric table, or the squareness of X and Y.
//
// Sign: a table contains errors E = actual - nominal of the moving body. The correction of an axis
// command is factor * E. For positioning the factor is -1 whichever body moves; for other errors it
// follows from the machine's chain (schema/rig/correction.h). The file of a controller contains
// either the correction or the error: its row in formats.cpp states which, and the source of this
// information.
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

// One error of one axis against the position of this axis.
struct Series {
  std::string error;   // "EXX"
  char along = 'X';    // axis whose position is x of the series
  char command = 'X';  // axis whose command gets the correction
  bool angle = false;
  int factor = 0;                                    // correction = factor * E; 0: unknown
  std::string gap;                                   // why the factor is unknown
  std::vector<double> position_m, forward, reverse;  // E; m or rad
};

struct ExportOptions {
  double tolerance_m = 0;     // largest error by left-out points; 0: keep all points. For angles in
                              // rad
  bool one_approach = false;  // one value for both approaches, although a reversal remains
  bool cut_range = false;     // use the longest range without missing values, instead of an error
  // Position at which the correction of an axis (mean of both approaches) is 0. axis 0: the
  // position for the only axis, not named. An axis without an entry is not shifted.
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
  // Limits of the residual: at most residual_m (for angles in rad) plus the tolerance, and at most
  // this share of the error. The share never demands less than a step of the controller's numbers.
  double residual_m = algo::ResidualLimits{}.most_m;
  double residual_share = algo::ResidualLimits{}.share;
  // LinuxCNC only: joints that get the table of an axis (two for a gantry); empty: X Y Z are 0 1 2.
  // inch: rows in inches instead of mm.
  struct Joint {
    char axis = 'X';
    int number = 0;
  };
  std::vector<Joint> joints;
  bool inch = false;
  // LinuxCNC only: MAX_ACCELERATION and SERVO_PERIOD of a joint with the table of this axis.
  struct Ramp {
    char axis = 'X';
    double max_acceleration_m_s2 = 0, period_s = 1e-3;
  };
  std::vector<Ramp> ramps;  // an axis without an entry: unknown
  // Siemens only: limits of the control; 0: 200 points, any number of tables.
  std::size_t siemens_points = 0, siemens_tables = 0;
  std::vector<std::string> marks;  // warnings for readers of the files
};

struct ControllerFile {
  std::string name, text;
};

// Number of points and thinning of a written series.
struct Written {
  std::string error;
  std::size_t points = 0, points_before = 0;
  double largest_deviation = 0;  // largest change by thinning, m or rad
};

struct Export {
  std::vector<ControllerFile> files;
  std::vector<Written> written;
  std::vector<std::string> left_out;  // errors that the controller cannot store
  std::vector<std::string> notes;
  double left_m = 0;  // volumetric table: largest part that the file format cannot represent
};

// The value that a controller adds to a command according to its rules: linear between the
// positions, constant beyond the ends, selected by the sign of the velocity.
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
  StatedAt at = kAtFixture;  // point at which the angle holds
};

// `write` makes the files; `read` gives the behaviour of the controller, by its own strict grammar,
// and its errors name file and line. Both are nullptr if the controller does not support the input.
struct AxisFiles {
  Result<Export> (*write)(const std::vector<CompensationTable>& tables,
                          const ExportOptions& options) = nullptr;
  Result<std::vector<AppliedCorrection>> (*read)(const std::vector<ControllerFile>& files) =
      nullptr;
};
struct VolumeFiles {
  Result<Export> (*write)(const VolumetricTable& table, const ExportOptions& options) = nullptr;
  // The grid and corrections, linear between the nodes; the files contain nothing else of a table.
  Result<VolumetricTable> (*read)(const std::vector<ControllerFile>& files) = nullptr;
};
struct SquareFiles {
  Result<Export> (*write)(const SquareAxes& axes, const ExportOptions& options) = nullptr;
  // k: the controller moves X to x + k y, with the commands x and y.
  Result<double> (*read)(const std::vector<ControllerFile>& files) = nullptr;
};

struct Format {
  const char* name;   // "linuxcnc"
  const char* of;     // name of the controller
  const char* holds;  // the content of a table that the format can store
  const char* limits;
  const char* sense;    // meaning of the values
  const char* source;   // source of this meaning
  bool sign_confirmed;  // otherwise the user must allow the export explicitly
  double quantum_m;     // step of its numbers; rad for a squareness
  bool takes_home;      // subtracts the correction at ExportOptions::home_m
  AxisFiles axes;       // one of axes, volume, square, or both axes and volume
  VolumeFiles volume;
  SquareFiles square;
  bool takes_joints = false;     // supports ExportOptions::joints, inch and ramps
  bool both_approaches = false;  // one value for each approach, so that it also corrects the
                                 // reversal
};

// In the order of the help.
const std::vector<Format>& formats();
// Controllers without a format: the reason, and the alternative.
struct UnsupportedController {
  const char *name, *of, *reason, *instead;
};
const std::vector<UnsupportedController>& not_written();
// Error (usage): lists the formats; for a controller of not_written() it gives the reason.
Result<const Format*> format_named(const std::string& name);

}  // namespace mdof::controllers
