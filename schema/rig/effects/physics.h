// Effects that change the gap that a capacitance probe reads, as a rig declares them:
//
//   [corrections]                    which effects are corrected
//   linearity = true                 default: true if the probe has a table or a polynomial
//   tilt = true                      default: false
//   dielectric = true                permittivity of the air; default: false
//   [[probe]] sensing_radius_mm, standoff_um, tilt_factor, u_tilt_factor, u_linearity_um
//   [air]                            see DeclaredAir
//
// The probe is on the side to which `measures` points. Therefore its gap is standoff -
// displacement. The equations are in algo/probe_physics.
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

// Quantities that determine the permittivity of the air: temperature in °C, pressure in kPa,
// relative humidity in %.
inline constexpr std::size_t kAirQuantities = 3;
using Air = std::array<double, kAirQuantities>;
struct AirQuantity {
  const char* key;   // key of [air] and column of a log: "humidity_percent"
  const char* name;  // "humidity"
  const char* unit;  // "%"
  double least, most;
};
const std::array<AirQuantity, kAirQuantities>& air_quantities();

// Keys of [air]: temperature_C, pressure_kPa, humidity_percent during the run. If a key is absent,
// the column of the log with the same name is used. With the prefix calibration_: values during the
// calibration of the probes. With the prefix u_ or u_calibration_: standard uncertainties.
struct DeclaredAir {
  std::array<std::optional<double>, kAirQuantities> run;
  Air calibration{};
  std::array<DeclaredUncertainty, kAirQuantities> u_run, u_calibration;
};

// Default of the tilt factor (algo/README.md states the reason), and half of the range of its
// possible values. The lower limit of this range is 1, the factor of an ideal disc.
inline constexpr double kUsualTiltFactor = 5;
inline constexpr double kTiltFactorHalfWidth = 4;

struct ProbePhysics {
  double sensing_radius_m = 0;  // 0: not declared
  double standoff_m = 0;        // gap at displacement 0; 0: not declared
  double tilt_factor = kUsualTiltFactor;
  DeclaredUncertainty u_tilt_factor;
  // Uncertainty of a displacement after its linearity correction; m.
  DeclaredUncertainty u_linearity;

  bool tilts() const { return sensing_radius_m > 0 && standoff_m > 0; }
};

struct RigPhysics {
  bool asked = false;  // true: there is a table [corrections]
  // Nullopt: linearity is corrected if the probe has a linearity table or a polynomial.
  std::optional<bool> linearity;
  bool tilt = false, dielectric = false;
  std::vector<ProbePhysics> probes;  // in the order of the rig
  std::optional<DeclaredAir> air;
  // If linearity = false: the calibrations of the probes before their linearity corrections were
  // removed, in the order of the rig.
  std::vector<std::shared_ptr<const Calibration>> left_out;

  bool corrects() const { return tilt || dielectric; }
  // Whether standoffs and air are known. The effect of the air is then known, even if it is not
  // corrected.
  bool has_known_air_effect() const;
};

// Reads all these keys into `rig.physics`; nullptr if the rig declares nothing. parse_rig() calls
// it after the probes have their calibrations. If linearity = false, removes the linearity
// corrections from the probes. Errors, and missing keys that a correction needs, are recorded in
// the table.
void read_physics(TomlTable& table, Rig& rig);

// As Rig::undeclared_uncertainties() and Rig::declares_uncertainty(), but for the keys that are
// listed above.
std::vector<std::string> undeclared_physics(const Rig& rig);
bool declares_physics(const Rig& rig);

// Columns that a correction requires in a log: "humidity_percent".
std::vector<std::string> air_columns(const Rig& rig);

// The value that the calibration adds to a reading (Calibration in rig.h), µm. Beyond the ends of a
// table, it is the value at the end.
double linearity_um(const Calibration& calibration, double reading_um);

// Readings t = raw - offset at the ends of the probe's range, µm.
std::array<double, 2> readings_of_range(const Probe& probe);

}  // namespace mdof
