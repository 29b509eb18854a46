// The fixture: positions and directions of the probes, and the calibration of their readings.
#pragma once

#include <array>
#include <cstddef>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "schema/axis.h"
#include "schema/base/result.h"
#include "schema/calibration/record.h"
#include "schema/notice/notice.h"
#include "schema/rig/chain.h"
#include "schema/rig/effects/expansion.h"
#include "schema/rig/report_facts.h"
#include "schema/rig/uncertainty.h"

namespace mdof {

// Constants from which the displacement of the target in the direction `measures` is calculated
// from the raw number of a channel:
//   raw_um = raw (or raw_V * um_per_V);   t = raw_um - offset_um;   t += linearity(t);
//   displacement = reads_gap ? -t : t
// If raw_um is outside `valid_um`, the reading is at an end of the probe's range.
struct Calibration {
  bool reads_gap = false;          // reads = "gap": the raw number increases with the gap
  bool reads_stated = false;       // the rig contains the key `reads`
  std::optional<double> um_per_V;  // required if the log has values in volts
  std::string scale_record;        // id of the calibration record that contains um_per_V
  double offset_um = 0;            // raw reading when the target surface is at its nominal position
  // [reading_um, correction_um], ascending. Constant beyond the ends.
  std::vector<std::array<double, 2>> linearity;
  std::vector<double> polynomial_um;  // alternative: correction in µm, Σ c_i (reading_um)^i
  // Limits of raw_um; default: from range_um and `reads`.
  std::optional<std::array<double, 2>> valid_um;
  // Range of t for which a calibration record is valid; nullopt: unknown.
  std::optional<std::array<double, 2>> calibrated_um = std::nullopt;
  std::string certificate;  // number of the calibration certificate
  std::string laboratory;   // laboratory that issued the certificate
  std::string calibrated;   // YYYY-MM-DD
  std::string due;          // YYYY-MM-DD: the last day on which the calibration is valid
};

struct Probe {
  std::string id;
  // Point in M at which the line of measurement meets the nominal target surface when the travel d
  // of the target is 0.
  Vec3 position_m{};
  // Unit vector in M, with components along the machine's axes. The probe reads the displacement in
  // this direction.
  Vec3 direction{};
  // Id of the target plane that the probe measures; empty: found from the direction of the probe.
  std::string plane;
  // Full range; the ends are at ±range/2, or at 0 and range for a probe that reads the gap.
  double range_m = 0;
  Calibration calibration;
  // Delay of the readings relative to their times. The filter of the probe's amplifier causes it.
  double delay_s = 0;
  ProbeUncertainty uncertainty = {};
  // The direction in the rig, if a calibration has found another direction. If there is no
  // [[plane]], the target was made and aligned perpendicular to this nominal direction.
  std::optional<Vec3> nominal_direction = {};
  // Gap when the surface is at its nominal position (standoff_um; with reads_gap, offset_um is used
  // if the key is missing); 0: not declared.
  double standoff_m = 0;
};

// Known flatness deviation of a target plane: height above the plane on a grid. Between the grid
// points the height is interpolated bilinearly; beyond the ends it is constant
// (algo/plausibility/map_cover.h reports where this happens). The coordinates are two axes of C, in
// the order x, y, z without the axis of the normal.
struct HeightMap {
  std::vector<double> first_m, second_m;
  std::vector<double> height_m;  // [first][second], row-major
  bool empty() const { return height_m.empty(); }
};

// A target plane in C: normal · p = offset. A probe measures the plane that its key `plane` names.
// If this key is absent, the probe measures the plane whose normal is nearest to the probe's
// direction, if there is only one such plane.
struct TargetPlane {
  std::string id;
  Vec3 normal{};
  std::optional<double> offset_m;  // nullopt: calculated from the positions of the probes
  HeightMap flatness;
  // Standard uncertainty of the height that the map does not contain, and the longest wavelength of
  // this unknown height.
  DeclaredUncertainty u_flatness = {};
  double flatness_length_m = 0.03;
};

struct RigPhysics;  // schema/rig/effects/physics.h

struct Rig {
  std::string name;
  Axis axis = Axis::x;
  std::vector<Probe> probes;
  // [encoder]: travel of the axis, in µm, per volt of an encoder with a voltage output; negative if
  // the voltage decreases when the position increases. nullopt: such an encoder is rejected.
  std::optional<double> encoder_um_per_V;
  double encoder_delay_s = 0;  // [encoder]: delay of the encoder's readings relative to their times
  Sides sides;                 // keys `moves` and `travel`
  Chain machine;               // [machine]; may be unknown
  // Empty: the planes are perpendicular to the nominal directions of the probes.
  std::vector<TargetPlane> planes;
  std::optional<Vec3> tool_point_m;  // tool point in M; default reference point of tables
  // The rigs of X and Y measure two faces of a square. The angle between these faces, inside
  // the material, is 90° plus this value.
  std::optional<double> artefact_angle_error_rad;
  std::optional<double> u_artefact_angle_rad;  // nullopt: not declared; 0: declared as negligible
  RigUncertainty uncertainty;
  RigExpansion expansion;
  // [drift]: limit for the drift of a probe during a run, m/s. A larger drift causes a notice.
  std::optional<double> drift_limit_m_per_s = std::nullopt;
  // Effects on the readings of capacitance probes, with the statement for each effect whether it is
  // corrected. nullptr: the rig declares no effects.
  std::shared_ptr<const RigPhysics> physics = nullptr;
  ReportFacts report;  // [report]
  // Calibration records of the rig. parse_rig() has already applied them (schema/rig/calibrated.h).
  std::vector<CalibrationRecord> records;
  std::string text;    // the TOML text of the rig and its records, for provenance
  std::string source;  // file name, for messages

  MovingAxis moving() const { return {axis, sides}; }

  std::optional<std::size_t> probe_index(std::string_view id) const;
  // Keys of uncertainty.h that apply to this rig and that the rig does not declare. A budget does
  // not include the contributions of these keys.
  std::vector<std::string> undeclared_uncertainties() const;
  bool declares_uncertainty() const;  // whether the rig declares any uncertainty
};

// Notices for results that were measured on this day (YYYY-MM-DD..., UTC): calibrations of probes,
// and records, whose validity has ended.
Notices overdue_calibrations(const Rig& rig, std::string_view day);

// Reads a rig (schema/README.md). If the rig has calibration records, the text must contain them,
// as load_rig_text() returns it. Errors name file, line and key; the error for an unknown key names
// the most similar known key.
Result<Rig> parse_rig(std::string_view toml_text, const std::string& source_name);
Result<Rig> load_rig(const std::filesystem::path& file);

}  // namespace mdof
