// A machine as a chain of frames from the workpiece to the tool, with the measured errors of its
// axes (algo/machine/README.md has the equations). Coordinates are those of the machine, fixed to
// the bed; if all commands are 0, they are also those of every body.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "schema/axis.h"
#include "schema/base/result.h"
#include "schema/rig/chain.h"
#include "schema/uncertainty/noise_only.h"

namespace mdof {

// The six errors of a body: along X, Y, Z (m) and about X, Y, Z, named A, B, C (rad).
inline constexpr std::size_t kBodyErrors = 6;

// An error of the body of an axis as a function of the command of the axis: actual - nominal. It is
// linear between the positions; outside, the end value is held.
struct ErrorFunction {
  std::vector<double> position;  // m or rad, strictly increasing; empty: a constant
  std::vector<double> forward;   // m or rad; empty: not measured
  std::vector<double> reverse;   // for decreasing command; empty: same as forward
  std::vector<double> u;         // standard uncertainty; empty: not declared
  std::string file;              // file name in MACHINE.toml; empty: the values are in MACHINE.toml
  // The part of u that is independent from position to position, such as noise; empty: unknown.
  std::vector<double> u_independent{};
  // For each interval, 1/m or rad/m²: the additional u between two positions because of linear
  // interpolation, ½ (x - x_i) (x_{i+1} - x) curvature; empty: none.
  std::vector<double> curvature{};
  bool noise_only = false;  // u contains only noise and repeatability

  bool known() const { return !forward.empty(); }
};

// Effect of one standard uncertainty of a quantity, which also affects errors of other bodies, on
// the six errors of a body; linear between the positions. [position of ErrorCovariance]
struct SharedPart {
  std::string name;  // "probe A: sensitivity"
  std::vector<std::array<double, kBodyErrors>> at;
};

using Covariance6 = std::array<std::array<double, kBodyErrors>, kBodyErrors>;

// Covariance of the errors of a body that one set of probes measured, as a function of the command:
// the sum of `noise`, `declared` and the squares of `shared`. They are stored separately, so that
// none is calculated as the difference of two large values.
struct ErrorCovariance {
  std::vector<double> position;         // m or rad, strictly increasing; empty: no covariance
  std::array<bool, kBodyErrors> has{};  // errors that it contains; the others have only their own u
  std::vector<Covariance6> noise;       // independent from position to position
  std::vector<Covariance6> declared;    // without `shared`
  // Entry p is the same quantity in all frames that have entries.
  std::vector<SharedPart> shared;
};

// Errors of the location of the line of an axis: a squareness, a position of a rotary axis.
struct LocationError {
  std::optional<double> value;  // m or rad; empty: not measured
  std::optional<double> u;      // empty: not declared
  bool noise_only = false;      // see ErrorFunction
};

// Rows of the database that a description names. They are read where the database is available
// (daemon/measure/machine); before that their values are unknown.
struct StoredRows {
  std::vector<std::int64_t> ids;
  bool latest = false;  // the newest row; ids is then empty
  bool any() const { return latest || !ids.empty(); }
};

// Whether a description states positioning as the position in the controller's coordinates, or as
// that of the body.
enum class StatedSense : std::uint8_t { none, command, body };

enum class FrameKind { linear, rotary, fixed };

struct MachineFrame {
  std::string id;  // letter of the axis, or name of a fixed frame
  FrameKind kind = FrameKind::fixed;
  std::size_t direction = 0;  // along or about X, Y, Z: 0, 1, 2; unused for a fixed frame
  bool carries_work = false;  // false: it carries the tool
  bool against_command = false;
  // Point where EXk, EYk, EZk hold; for a rotary axis a point on the axis. m.
  Vec3 at_m{};
  // Whether the point moves with the body of a linear axis. If not, it is at rest, like a fixture
  // in the spindle over a table.
  bool point_moves = false;
  // For a body of kind `fixed` that moves along `direction` with the command of a linear axis, like
  // the sliding rod of a tilt drive: the letter of this axis, and the ratio of both travels. 0: it
  // does not move.
  char moves_with = 0;
  double ratio = 0;
  std::array<ErrorFunction, kBodyErrors> error;
  std::array<LocationError, kBodyErrors> location;
  ErrorCovariance covariance;                  // covariance of the errors of the body
  std::optional<std::array<double, 2>> range;  // used range of the command, m or rad
  // Position of a linear axis while the others were measured. Its angles from stored runs and
  // tables are 0 there, because the squareness of the others contains them. m; empty: 0 is assumed.
  std::optional<double> angles_zero_m;

  // Whether the error was measured; `of_line`: the error of the location.
  bool is_known(std::size_t k, bool of_line) const {
    return of_line ? location[k].value.has_value() : error[k].known();
  }
  std::string file;  // file with columns for several errors; empty: none
  // Sense of the error along a linear axis in the description. Values in a file are not yet
  // converted. none: values in the description are of the body, and a file must state the sense if
  // it matters.
  StatedSense positioning_sense = StatedSense::none;
  StoredRows runs;    // runs of the axis, with five probes or imported; their means are used
  StoredRows tables;  // compensation tables of the axis
};

// A source of errors that varies and was not measured: a screw, a clearance, an assembly. It can
// have several effects at the same time.
enum class SourceShape { normal, rectangular, triangular, u_shaped };

struct SourceEffect {
  std::size_t frame = 0, k = 0;  // index in Machine::frames; index of the error
  bool of_line = false;          // true: a location error; false: an error of the body
  double factor = 0;             // error per source: m or rad per unit of the source
  // The same per command of the axis `of`, m or rad.
  double factor_per_position = 0;
  std::size_t of = 0;  // index in Machine::frames
};

struct ErrorSource {
  std::string name, unit;  // the unit is only text; the factors convert
  double u = 0;            // standard uncertainty, in this unit
  SourceShape shape = SourceShape::normal;
  std::vector<SourceEffect> acts_on;
};

struct Machine {
  std::string name;
  Chain chain;
  std::vector<MachineFrame> frames;  // from the workpiece to the tool
  Vec3 tool_m{};                     // tool point
  bool simulated = false;
  std::vector<ErrorSource> sources;
  StoredRows squareness;  // at most one for each pair of axes, or the latest

  const MachineFrame* find(std::string_view id) const;
  bool names_stored_rows() const;  // whether the database is needed
};

// Whether the u of all, some or none of its errors contains only noise; errors without u do not
// count. `with_sources`: includes the sources, which declare their u.
NoiseOnly noise_only(const Machine& machine, bool with_sources = false);
// Sentence about the contributors of the u of the tool error. `some_without_u`: an error that acts
// there has no u.
std::string covers_text(const Machine& machine, bool some_without_u, bool with_sources = false);

// The axes of a chain without errors; their positions are unknown.
Machine nominal_machine(const Chain& chain);

// Whether its body moves along a line, as a linear axis or together with one.
bool moves_along(const MachineFrame& frame);

// "EXX", "EX(column)"; for the location of an axis "EC0Y".
std::string error_name(const MachineFrame& frame, std::size_t k);
std::string location_name(const MachineFrame& frame, std::size_t k);
// The name with its unit: "EXX_um", "EAX_urad".
std::string with_unit(const std::string& name, std::size_t k);
// Whether an axis can have this location error: a rotation about itself and, for a linear axis, a
// shift are not possible.
bool has_location(const MachineFrame& frame, std::size_t k);

// Converts positioning in the sense of the command to that of the body.
void convert_positioning(MachineFrame& frame);

// Converts written positions of an axis: mm, for a rotary axis degrees.
double position_from_written(const MachineFrame& frame, double written);
double written_position(const MachineFrame& frame, double position);
const char* position_unit(const MachineFrame& frame);  // "mm", "deg"

// Errors: numbers of values and positions differ; positions do not increase; values are not finite
// or larger than in any machine (0.1 rad, 10 mm: confusion of µm and mm). `where` begins the
// message.
Status check_function(const ErrorFunction& function, std::size_t k, const std::string& where);

const char* to_string(SourceShape shape);

// The machine of Wang, Ye and Gunawan (2021) as MACHINE.toml; the text marks what the paper does
// not state.
std::string_view co_planar_machine();

// Reads MACHINE.toml (schema/machine/README.md). Errors name file, line, key and remedy. Other
// files are not read: `file` of a frame or of an error names them.
Result<Machine> parse_machine(std::string_view text, const std::string& source_name);

}  // namespace mdof
