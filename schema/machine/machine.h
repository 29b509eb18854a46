// A machine: a chain of frames from the workpiece to the tool, with the measured errors of the axes
// (algo/machine/README.md has the equations). The machine coordinates are fixed to the bed. If all
// commands are 0, the coordinates of every body are the same as the machine coordinates.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "schema/axis.h"
#include "schema/base/result.h"
#include "schema/notice/notice.h"
#include "schema/rig/chain.h"
#include "schema/uncertainty/noise_only.h"

namespace mdof {

// The six errors of a body: translations along X, Y, Z (m) and rotations A, B, C about X, Y, Z
// (rad).
inline constexpr std::size_t kBodyErrors = 6;

// An error (actual - nominal) of the body of an axis as a function of the command of the axis. It
// is interpolated linearly between the positions; outside, the end value is used.
struct ErrorFunction {
  std::vector<double> position;  // m or rad, strictly increasing; empty: a constant
  std::vector<double> forward;   // m or rad; empty: not measured
  std::vector<double> reverse;   // values for decreasing command; empty: same as forward
  std::vector<double> u;         // standard uncertainty; empty: not declared
  std::string file;              // file name in MACHINE.toml; empty: the values are in MACHINE.toml
  // The part of u that is independent from position to position, such as noise; empty: unknown.
  std::vector<double> u_independent{};
  // Curvature in each interval, 1/m or rad/m². Linear interpolation at x between x_i and x_{i+1}
  // adds a standard uncertainty of ½ (x - x_i) (x_{i+1} - x) curvature. Empty: it adds none. Beyond
  // the ends, u always contains the slope of the end interval.
  std::vector<double> curvature{};
  bool noise_only = false;  // u contains only noise and repeatability

  bool known() const { return !forward.empty(); }
};

// A quantity that affects the errors of several bodies. `at` is the effect of one standard
// uncertainty of this quantity on the six errors of a body, for each position of ErrorCovariance;
// it is interpolated linearly between the positions.
struct SharedPart {
  std::string name;  // "probe A: sensitivity"
  std::vector<std::array<double, kBodyErrors>> at;
};

using Covariance6 = std::array<std::array<double, kBodyErrors>, kBodyErrors>;

// Covariance of the errors of a body that were measured with the same probes, as a function of the
// command. It is the sum of `noise`, `declared` and, for each part of `shared`, the products of the
// effects of this part on two errors. The three terms are stored separately, so that no term is
// calculated as the difference of two large values.
struct ErrorCovariance {
  std::vector<double> position;  // m or rad, strictly increasing; empty: no covariance
  // True: the covariance contains this error; false: the error has only its u.
  std::array<bool, kBodyErrors> has{};
  std::vector<Covariance6> noise;     // independent from position to position
  std::vector<Covariance6> declared;  // without `shared`
  // Element p is the same quantity in all frames whose `shared` is not empty.
  std::vector<SharedPart> shared;
};

// An error of the location or orientation of the line of an axis, for example a squareness or the
// position of a rotary axis.
struct LocationError {
  std::optional<double> value;  // m or rad; empty: not measured
  std::optional<double> u;      // empty: not declared
  bool noise_only = false;      // u contains only noise and repeatability
};

// Database rows to which MACHINE.toml refers. daemon/measure/machine reads the rows; until then,
// the errors in these rows are unknown.
struct StoredRows {
  std::vector<std::int64_t> ids;
  bool latest = false;  // true: the newest row; ids is then empty
  bool any() const { return latest || !ids.empty(); }
};

// Sense in which MACHINE.toml states the positioning error. command: in the coordinates of the
// controller; body: as the motion of the body.
enum class StatedSense : std::uint8_t { none, command, body };

enum class FrameKind { linear, rotary, fixed };

struct MachineFrame {
  std::string id;  // letter of the axis, or name of a fixed frame
  FrameKind kind = FrameKind::fixed;
  // Direction or rotation axis: 0, 1, 2 for X, Y, Z; unused for a fixed frame.
  std::size_t direction = 0;
  bool carries_work = false;  // true: between bed and workpiece; false: between bed and tool
  bool against_command = false;
  // Reference point of the linear errors of the body (EXk, EYk, EZk), m. For a rotary axis it is a
  // point on the axis.
  Vec3 at_m{};
  // true: the point moves with the body of the linear axis. false: the point is at rest, like a
  // fixture in the spindle above a moving table.
  bool point_moves = false;
  // A body of kind `fixed` can move along `direction` with the command of a linear axis, like the
  // sliding rod of a tilt drive. `moves_with` is the letter of this axis; 0: the body does not
  // move. `ratio` is the travel of the body / travel of the axis.
  char moves_with = 0;
  double ratio = 0;
  std::array<ErrorFunction, kBodyErrors> error;
  std::array<LocationError, kBodyErrors> location;
  ErrorCovariance covariance;                  // covariance of the errors of the body
  std::optional<std::array<double, 2>> range;  // range of the command that is used, m or rad
  // Position of a linear axis while the other axes were measured, m; empty: 0 is assumed. The
  // angles of this axis from stored runs and tables are set to 0 at this position, because the
  // squareness of the other axes contains the angles at this position.
  std::optional<double> angles_zero_m;

  // Returns whether an error of the body was measured; with `of_line`, whether a location error was
  // measured.
  bool is_known(std::size_t k, bool of_line) const {
    return of_line ? location[k].value.has_value() : error[k].known();
  }
  std::string file;  // file with columns for several errors; empty: no such file
  // Sense of the positioning error of a linear axis in MACHINE.toml. Values in a file are not yet
  // converted. none: values in MACHINE.toml have the sense of the body, and a file must state its
  // sense if the two senses differ.
  StatedSense positioning_sense = StatedSense::none;
  // Runs of the axis, measured with five probes or imported; the means of the runs are used.
  StoredRows runs;
  StoredRows tables;  // compensation tables of the axis
};

// Distribution of an error source.
enum class SourceShape { normal, rectangular, triangular, u_shaped };

struct SourceEffect {
  std::size_t frame = 0, k = 0;  // index in Machine::frames; index of the error
  bool of_line = false;          // true: a location error; false: an error of the body
  double factor = 0;             // error / source: m or rad per unit of the source
  // Change of `factor` per unit (m or rad) of the command of the axis `of`.
  double factor_per_position = 0;
  std::size_t of = 0;  // index in Machine::frames
};

// A quantity that varies, was not measured and causes errors: for example the error of a screw, a
// clearance or an assembly. It can affect several errors at the same time.
struct ErrorSource {
  std::string name, unit;  // the unit is only a text
  double u = 0;            // standard uncertainty of the source in this unit
  SourceShape shape = SourceShape::normal;
  std::vector<SourceEffect> acts_on;
};

struct Machine {
  std::string name;
  Chain chain;
  std::vector<MachineFrame> frames;  // from the workpiece to the tool
  Vec3 tool_m{};                     // position of the tool point
  bool simulated = false;
  std::vector<ErrorSource> sources;
  StoredRows squareness;  // at most one for each pair of axes, or the latest
  Notices notices;        // about the errors that were read from the database

  const MachineFrame* find(std::string_view id) const;
  bool names_stored_rows() const;  // true: the database is necessary
};

// Returns whether the u of all, some or none of the errors contains only noise. Errors without u
// are ignored. `with_sources`: the sources are included; their u is declared.
NoiseOnly noise_only(const Machine& machine, bool with_sources = false);
// Returns a sentence about the contributors to the u of the tool error. `some_without_u`: an error
// that affects the tool has no u.
std::string covers_text(const Machine& machine, bool some_without_u, bool with_sources = false);

// Returns a machine with the axes of a chain and without errors. The positions of the axes are
// unknown.
Machine nominal_machine(const Chain& chain);

// Returns whether the body of the frame moves along a line: it is a linear axis or moves with a
// linear axis.
bool moves_along(const MachineFrame& frame);

// error_name() returns for example "EXX" or "EX(column)", location_name() for example "EC0Y".
std::string error_name(const MachineFrame& frame, std::size_t k);
std::string location_name(const MachineFrame& frame, std::size_t k);
// Returns the name with its unit, for example "EXX_um" or "EAX_urad".
std::string with_unit(const std::string& name, std::size_t k);
// Returns whether an axis can have this location error. A rotation of the line about itself is not
// possible, and a shift is not possible for a linear axis.
bool has_location(const MachineFrame& frame, std::size_t k);

// Converts the positioning error from the sense of the command to the sense of the body.
void convert_positioning(MachineFrame& frame);

// Convert between the position of an axis (m or rad) and its value in files (mm, or degrees for a
// rotary axis).
double position_from_written(const MachineFrame& frame, double written);
double written_position(const MachineFrame& frame, double position);
const char* position_unit(const MachineFrame& frame);  // "mm", "deg"

// `where` is the start of the error message. Errors: different numbers of values and positions;
// positions that do not increase; values that are not finite, or are above 0.1 rad or 10 mm and
// thus probably in a wrong unit.
Status check_function(const ErrorFunction& function, std::size_t k, const std::string& where);

const char* to_string(SourceShape shape);

// Returns the machine of Wang, Ye and Gunawan (2021) as text of MACHINE.toml. Comments in the text
// mark values that the paper does not state.
std::string_view co_planar_machine();

// Reads MACHINE.toml (schema/machine/README.md). The files that MACHINE.toml names are not read;
// `file` of a frame or of an error is such a name. Errors state file, line, key and what to change.
Result<Machine> parse_machine(std::string_view text, const std::string& source_name);

}  // namespace mdof
