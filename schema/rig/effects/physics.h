// Effects on the reading of the gap by a capacitance probe, as a rig declares them:
//
//   [corrections]                    true or false; defaults as without [corrections]:
//   linearity = true                 a table or polynomial is applied, tilt and air are not
//   tilt = true
//   dielectric = true
//   [[probe]] sensing_radius_mm, standoff_um, tilt_factor, u_tilt_factor, u_linearity_um
//   [air]                            see DeclaredAir
//
// The probe is on the side to which `measures` points: its gap is standoff - displacement. The
// equations are in algo/probe_physics.
#pragma once

#include <array>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "schema/base/toml/toml_reader.h"
#include "schema/rig/uncertainty.h"

namespace mdof {

struct Rig;
struct Calibration;
struct Probe;

// Quantities that determine the permittivity of the air: degrees Celsius, kPa, % relative humidity.
inline constexpr std::size_t kAirQuantities = 3;
using Air = std::array<double, kAirQuantities>;
struct AirQuantity {
  const char* key;   // key of [air] and column of a log: "humidity_percent"
  const char* name;  // "humidity"
  const char* unit;  // "%"
  double least, most;
};
const std::array<AirQuantity, kAirQuantities>& air_quantities();

// [air]: temperature_C, pressure_kPa, humidity_percent during the run; if absent, from the columns
// of the log with the same names. With prefix calibration_: during the calibration of the probes.
// With prefix u_ or u_calibration_: standard uncertainties.
struct DeclaredAir {
  std::array<std::optional<double>, kAirQuantities> run;
  Air calibration{};
  std::array<DeclaredUncertainty, kAirQuantities> u_run, u_calibration;
};

// Default tilt factor (algo/README.md gives the reason). The limits are the factor of an ideal
// disc, 1, and the same distance on the other side.
inline constexpr double kUsualTiltFactor = 5;
inline constexpr double kTiltFactorHalfWidth = 4;

struct ProbePhysics {
  double sensing_radius_m = 0;  // 0: not declared
  double standoff_m = 0;        // gap at displacement 0; 0: not declared
  double tilt_factor = kUsualTiltFactor;
  DeclaredUncertainty u_tilt_factor;
  DeclaredUncertainty u_linearity;  // of a displacement after its correction; m

  bool tilts() const { return sensing_radius_m > 0 && standoff_m > 0; }
};

struct RigPhysics {
  bool asked = false;             // there is a table [corrections]
  std::optional<bool> linearity;  // absent: linearity is corrected if the rig has a table
  bool tilt = false, dielectric = false;
  std::vector<ProbePhysics> probes;  // in the order of the rig
  std::optional<DeclaredAir> air;
  // linearity = false: the original calibrations of the probes, in the order of the rig.
  std::vector<std::shared_ptr<const Calibration>> left_out;

  bool corrects() const { return tilt || dielectric; }
  // Standoffs and air are known, so the effect of the air is known, whether it is corrected or not.
  bool has_known_air_effect() const;
};

// Reads all these keys into `rig.physics`, for parse_rig(), after the probes have their
// calibrations; nullptr if the rig declares nothing. linearity = false removes the corrections from
// the probes. Errors and keys missing for a correction are recorded in the table.
void read_physics(TomlTable& table, Rig& rig);

// As Rig::undeclared_uncertainties() and Rig::declares_uncertainty(), for the keys of this file.
std::vector<std::string> undeclared_physics(const Rig& rig);
bool declares_physics(const Rig& rig);

// Columns that a correction requires in a log: "humidity_percent".
std::vector<std::string> air_columns(const Rig& rig);

// Value that the calibration adds to a reading (Calibration in rig.h), µm; beyond a table its end
// value.
double linearity_um(const Calibration& calibration, double reading_um);

// Readings t = raw - offset at the ends of the probe's range, µm.
std::array<double, 2> readings_of_range(const Probe& probe);

}  // namespace mdof
