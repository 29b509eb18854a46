// A machine as a chain of frames from the work to the tool, with the measured errors of its axes
// (algo/machine/README.md has the equations). Coordinates are those of the machine, fixed to the
// bed, and of every body when all commands are 0.
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

// The six errors of a body: along X, Y, Z (m), about X, Y, Z, that is A, B, C (rad).
inline constexpr std::size_t kBodyErrors = 6;

// An error of the body that an axis moves against the command of the axis: actual - nominal.
// Linear between the positions; beyond them the end value is held.
struct ErrorFunction {
  std::vector<double> position;  // m or rad, strictly increasing; empty: a constant
  std::vector<double> forward;   // m or rad; empty: not measured
  std::vector<double> reverse;   // as the command falls; empty: the same
  std::vector<double> u;         // standard uncertainty; empty: not declared
  std::string file;              // where it stands, as MACHINE.toml names it; empty: here
  // The part of u that is independent from position to position, as noise; empty: none is known.
  std::vector<double> u_independent{};
  // Of each interval, 1/m or rad/m²: what u adds between two positions, as a straight line misses
  // the error there: ½ (x - x_i) (x_{i+1} - x) curvature; empty: none.
  std::vector<double> curvature{};
  bool noise_only = false;  // u contains noise and repeatability alone

  bool known() const { return !forward.empty(); }
};

// What one standard uncertainty of a quantity, which the errors of other bodies have too, does to
// the six errors of a body; linear between the positions. [position of ErrorCovariance]
struct SharedPart {
  std::string name;  // "probe A: sensitivity"
  std::vector<std::array<double, kBodyErrors>> at;
};

using Covariance6 = std::array<std::array<double, kBodyErrors>, kBodyErrors>;

// Covariance of the errors of a body that one set of probes has shown, by the command: the sum of
// `noise`, `declared` and the squares of `shared`. Each is kept apart, so that none is found as the
// difference of two large ones.
struct ErrorCovariance {
  std::vector<double> position;         // m or rad, strictly increasing; empty: nothing is known
  std::array<bool, kBodyErrors> has{};  // the errors it is of; each other has its own u alone
  std::vector<Covariance6> noise;       // independent from position to position
  std::vector<Covariance6> declared;    // without `shared`
  std::vector<SharedPart> shared;       // number p is the same quantity in all frames that have any
};

// Of where the line of an axis lies: a squareness, a place of a rotary axis.
struct LocationError {
  std::optional<double> value;  // m or rad; none: not measured
  std::optional<double> u;      // none: not declared
  bool noise_only = false;      // as of ErrorFunction
};

// Rows of the database that a description names; whoever has the database takes them
// (daemon/measure/machine). Not known before that.
struct StoredRows {
  std::vector<std::int64_t> ids;
  bool latest = false;  // the newest there is; without ids
  bool any() const { return latest || !ids.empty(); }
};

// Whether a description says that positioning is that of the place in the controller's coordinates,
// or that of the body.
enum class StatedSense : std::uint8_t { none, command, body };

enum class FrameKind { linear, rotary, fixed };

struct MachineFrame {
  std::string id;  // letter of the axis; of a fixed frame its name
  FrameKind kind = FrameKind::fixed;
  std::size_t direction = 0;  // along or about X, Y, Z: 0, 1, 2; not of a fixed frame
  bool carries_work = false;  // else the tool
  bool against_command = false;
  // Where EXk, EYk, EZk hold; of a rotary axis a point of the axis. m.
  Vec3 at_m{};
  // The point goes with the body of a linear axis; else it stands still, as a fixture in the
  // spindle does over a table.
  bool point_moves = false;
  // Of a body of kind `fixed` that goes along `direction` with the command of a linear axis, as the
  // sliding rod of a tilt drive does: that axis, and how far by how far. 0: it does not move.
  char moves_with = 0;
  double ratio = 0;
  std::array<ErrorFunction, kBodyErrors> error;
  std::array<LocationError, kBodyErrors> location;
  ErrorCovariance covariance;                  // of the errors of the body
  std::optional<std::array<double, 2>> range;  // of the command that is used, m or rad
  // Where a linear axis stood while the others were measured: its angles of stored runs and tables
  // are 0 there, as what they were there is in the squareness of the others. m; none: 0 is assumed.
  std::optional<double> angles_zero_m;

  // Whether the error was measured; `of_line`: that of the location.
  bool is_known(std::size_t k, bool of_line) const {
    return of_line ? location[k].value.has_value() : error[k].known();
  }
  std::string file;  // columns of several errors; empty: none
  // Of the error along a linear axis that the description gives; not yet turned where it stands in
  // a file. None: its own rows are of the body, and a file has to say where it matters.
  StatedSense positioning_sense = StatedSense::none;
  StoredRows runs;    // of the axis, five-probe runs or imported ones: their means
  StoredRows tables;  // compensation tables of the axis
};

// What may vary and was not measured: a screw, a clearance, an assembly. It may act at several
// places at once.
enum class SourceShape { normal, rectangular, triangular, u_shaped };

struct SourceEffect {
  std::size_t frame = 0, k = 0;    // of Machine::frames; of the six
  bool of_line = false;            // a location error; else an error of the body
  double factor = 0;               // of the error by the source: m or rad by the source's unit
  double factor_per_position = 0;  // the same, times the command of the axis `of`: by m or rad
  std::size_t of = 0;              // of Machine::frames
};

struct ErrorSource {
  std::string name, unit;  // the unit is a word: the factors convert
  double u = 0;            // standard uncertainty, in its unit
  SourceShape shape = SourceShape::normal;
  std::vector<SourceEffect> acts_on;
};

struct Machine {
  std::string name;
  Chain chain;
  std::vector<MachineFrame> frames;  // from the work to the tool
  Vec3 tool_m{};                     // the tool's point
  bool simulated = false;
  std::vector<ErrorSource> sources;
  StoredRows squareness;  // of each two axes at most one, or the latest

  const MachineFrame* find(std::string_view id) const;
  bool names_stored_rows() const;  // so that it needs the database
};

// Of the errors that have a u; `with_sources`: and of its sources, which declare theirs.
NoiseOnly noise_only(const Machine& machine, bool with_sources = false);
// What u of the error of its tool contains. `some_without_u`: an error that acts there has none.
std::string covers_text(const Machine& machine, bool some_without_u, bool with_sources = false);

// The axes of the chain alone, without errors; where they are is not known.
Machine nominal_machine(const Chain& chain);

// Whether its body goes along a line, as a linear axis or with one.
bool moves_along(const MachineFrame& frame);

// "EXX", "EX(column)"; of the line of an axis "EC0Y".
std::string error_name(const MachineFrame& frame, std::size_t k);
std::string location_name(const MachineFrame& frame, std::size_t k);
// The name with its unit: "EXX_um", "EAX_urad".
std::string with_unit(const std::string& name, std::size_t k);
// Whether an axis can have this error of its line: a turn about itself and, of a linear axis, a
// shift are none.
bool has_location(const MachineFrame& frame, std::size_t k);

// Turns positioning that is in the sense of the command into that of the body.
void turn_positioning(MachineFrame& frame);

// Positions of an axis as they are written: mm, of a rotary axis degrees.
double position_from_written(const MachineFrame& frame, double written);
double written_position(const MachineFrame& frame, double position);
const char* position_unit(const MachineFrame& frame);  // "mm", "deg"

// Errors: as many values as positions, increasing, finite, below what any machine has (0.1 rad,
// 10 mm: µm and mm mixed up). `where` begins the message.
Status check_function(const ErrorFunction& function, std::size_t k, const std::string& where);

const char* to_string(SourceShape shape);

// The machine of Wang, Ye and Gunawan (2021) as MACHINE.toml; what the paper does not give is
// marked in the text.
std::string_view co_planar_machine();

// MACHINE.toml (schema/machine/README.md). Errors name file, line, key and remedy. What stands in
// other files is not read: `file` of a frame or of an error says which.
Result<Machine> parse_machine(std::string_view text, const std::string& source_name);

}  // namespace mdof
