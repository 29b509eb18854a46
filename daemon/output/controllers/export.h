// Compensation tables as files of machine controllers: pure functions from values to texts and
// back.
//
// What goes in is tables of axes, a volumetric table, or the squareness of X and Y.
//
// Sense. A table holds errors E = actual - nominal of the body that moves. What is added to the
// command of an axis so that the error vanishes is factor * E: of positioning -E whichever body
// moves, of the others by the machine's chain (schema/rig/correction.h). A controller's file may
// hold the correction or the error: its row in formats.cpp says which, and where that is known
// from.
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

// One error of one axis against the position of that axis.
struct Series {
  std::string error;   // "EXX"
  char along = 'X';    // the axis by whose position it is stated
  char command = 'X';  // the axis whose command takes the correction
  bool angle = false;
  int factor = 0;                                    // correction = factor * E; 0: not known
  std::string gap;                                   // why it is not
  std::vector<double> position_m, forward, reverse;  // E; m or rad
};

struct ExportOptions {
  double tolerance_m = 0;     // points are left out within it; 0: none is. Of angles in rad
  bool one_approach = false;  // one value for both approaches, though a reversal stays
  bool cut_range = false;     // the longest range without a missing value, instead of refusing
  // Where the correction of an axis is 0 (mean of both approaches); axis 0: a number for one axis
  // that was not named. An axis without one is not shifted.
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
  // What may be left with the correction: no more than this beside the tolerance, of angles in rad,
  // and no more than this share of what there was; a step of the controller's numbers is always.
  double residual_m = algo::ResidualLimits{}.most_m;
  double residual_share = algo::ResidualLimits{}.share;
  // LinuxCNC alone: which joints take the table of an axis, two for a gantry; empty: X Y Z are 0 1
  // 2. Rows in inches instead of mm.
  struct Joint {
    char axis = 'X';
    int number = 0;
  };
  std::vector<Joint> joints;
  bool inch = false;
  // LinuxCNC alone: MAX_ACCELERATION and SERVO_PERIOD of a joint with the table of this axis.
  struct Ramp {
    char axis = 'X';
    double max_acceleration_m_s2 = 0, period_s = 1e-3;
  };
  std::vector<Ramp> ramps;  // of an axis none: not known
  // Siemens alone: the control's own limits; 0: points 200, tables as many as there are.
  std::size_t siemens_points = 0, siemens_tables = 0;
  std::vector<std::string> marks;  // what a reader of the files has to know
};

struct ControllerFile {
  std::string name, text;
};

// What became of a series.
struct Written {
  std::string error;
  std::size_t points = 0, points_before = 0;
  double largest_deviation = 0;  // by thinning, m or rad
};

struct Export {
  std::vector<ControllerFile> files;
  std::vector<Written> written;
  std::vector<std::string> left_out;  // what the controller cannot hold
  std::vector<std::string> notes;
  double left_m = 0;  // of a volumetric table: what the form of the file cannot hold
};

// What a controller adds to a command, as its own rules read the files: linear between the
// positions, held beyond the ends, chosen by the sign of the velocity.
struct AppliedCorrection {
  std::string error;
  char along = 'X', command = 'X';
  std::vector<double> position_m, forward, reverse;  // correction, m or rad
};

// The angle between X and Y, and how the machine's commands go.
struct SquareAxes {
  std::int64_t id = 0;  // of the stored squareness
  double EC0Y_rad = 0;
  Budget budget;  // of EC0Y
  Chain machine;
  StatedAt at = kAtFixture;  // where the angle holds
};

// Of each pair: to files, and what the controller does with them by its own strict grammar; an
// error of the latter names file and line. Both are nullptr where the controller holds no such
// thing.
struct AxisFiles {
  Result<Export> (*write)(const std::vector<CompensationTable>& tables,
                          const ExportOptions& options) = nullptr;
  Result<std::vector<AppliedCorrection>> (*read)(const std::vector<ControllerFile>& files) =
      nullptr;
};
struct VolumeFiles {
  Result<Export> (*write)(const VolumetricTable& table, const ExportOptions& options) = nullptr;
  // Its grid and corrections, linear between the nodes; nothing else of a table is in the files.
  Result<VolumetricTable> (*read)(const std::vector<ControllerFile>& files) = nullptr;
};
struct SquareFiles {
  Result<Export> (*write)(const SquareAxes& axes, const ExportOptions& options) = nullptr;
  // k: the controller moves X to x + k y, where x and y are commanded.
  Result<double> (*read)(const std::vector<ControllerFile>& files) = nullptr;
};

struct Format {
  const char* name;   // "linuxcnc"
  const char* of;     // the controller
  const char* holds;  // what of a table goes in
  const char* limits;
  const char* sense;    // what its values mean
  const char* source;   // where that sense is known from
  bool sign_confirmed;  // else the export has to be asked for
  double quantum_m;     // step of its numbers; of a squareness rad
  bool takes_home;      // ExportOptions::home_m is taken out of it
  AxisFiles axes;       // one of the three, or axes and a volume
  VolumeFiles volume;
  SquareFiles square;
  bool takes_joints = false;     // ExportOptions::joints, inch and ramps
  bool both_approaches = false;  // has a value for each, so that it also corrects the reversal
};

// In the order of the help.
const std::vector<Format>& formats();
// Controllers for which no file is written: why, and what to use instead.
struct NotWritten {
  const char *name, *of, *reason, *instead;
};
const std::vector<NotWritten>& not_written();
// Error (usage): names those there are; of one that is not written, the reason.
Result<const Format*> format_named(const std::string& name);

}  // namespace mdof::controllers
