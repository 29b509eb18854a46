// What makes a capacitance probe read another gap than there is, as far as a rig declares it:
//
//   [corrections]                    each true or false; not named: as it is without this table
//   linearity = true                 (a table or polynomial is applied, tilt and air are not)
//   tilt = true
//   dielectric = true
//   [[probe]] sensing_radius_mm, standoff_um, tilt_factor, u_tilt_factor, u_linearity_um
//   [air]                            see DeclaredAir
//
// The probe stands where `measures` points: its gap is standoff - displacement. The equations are
// those of algo/probe_physics.
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

// Of air, what its permittivity depends on: degrees Celsius, kPa, % relative humidity.
inline constexpr std::size_t kAirQuantities = 3;
using Air = std::array<double, kAirQuantities>;
struct AirQuantity {
  const char* key;   // of [air], and the name of a log's column: "humidity_percent"
  const char* name;  // "humidity"
  const char* unit;  // "%"
  double least, most;
};
const std::array<AirQuantity, kAirQuantities>& air_quantities();

// [air]: temperature_C, pressure_kPa, humidity_percent of the run, else of the log's columns of the
// same names; the same with calibration_ before it, of when the probes were calibrated; and with u_
// or u_calibration_ before that, standard uncertainties.
struct DeclaredAir {
  std::array<std::optional<double>, kAirQuantities> run;
  Air calibration{};
  std::array<DeclaredUncertainty, kAirQuantities> u_run, u_calibration;
};

// Where a rig names none (algo/README.md says why): the limits are those of an ideal disc, 1, and
// as far on the other side.
inline constexpr double kUsualTiltFactor = 5;
inline constexpr double kTiltFactorHalfWidth = 4;

struct ProbePhysics {
  double sensing_radius_m = 0;  // 0: not declared
  double standoff_m = 0;        // gap at displacement 0; 0: not declared
  double tilt_factor = kUsualTiltFactor;
  DeclaredUncertainty u_tilt_factor;
  DeclaredUncertainty u_linearity;  // of a displacement, after its correction; m

  bool tilts() const { return sensing_radius_m > 0 && standoff_m > 0; }
};

struct RigPhysics {
  bool asked = false;             // there is a table [corrections]
  std::optional<bool> linearity;  // not named: a table that the rig has is applied
  bool tilt = false, dielectric = false;
  std::vector<ProbePhysics> probes;  // in the order of the rig
  std::optional<DeclaredAir> air;
  // linearity = false: what the probes' calibrations lost, in the order of the rig.
  std::vector<std::shared_ptr<const Calibration>> left_out;

  bool corrects() const { return tilt || dielectric; }
  // Its gaps and its air are known, so that the air's effect is, whether it is corrected or not.
  bool knows_air() const;
};

// Reads all of it, for parse_rig(), once the probes have their calibrations: `rig.physics`, none
// where the rig says nothing. linearity = false takes the corrections from the probes. What is
// wrong, or missing for what is asked, is recorded in the table.
void read_physics(TomlTable& table, Rig& rig);

// As Rig::undeclared_uncertainties() and Rig::declares_uncertainty(), of what stands here.
std::vector<std::string> undeclared_physics(const Rig& rig);
bool declares_physics(const Rig& rig);

// Columns that a log must have for a correction: "humidity_percent".
std::vector<std::string> columns_of_air(const Rig& rig);

// What the calibration adds to a reading (Calibration in rig.h), µm; the ends of a table are held.
double linearity_um(const Calibration& calibration, double reading_um);

// Readings t = raw - offset at the ends of the probe's range, µm.
std::array<double, 2> readings_of_range(const Probe& probe);

}  // namespace mdof
