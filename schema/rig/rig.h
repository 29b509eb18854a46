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

// From the raw number of a channel to the displacement of the target along `measures`:
//   raw_um = raw (or raw_V * um_per_V);   t = raw_um - offset_um;   t += linearity(t);
//   displacement = reads_gap ? -t : t
// Outside `valid_um` a reading is at the end of the probe's range.
struct Calibration {
  bool reads_gap = false;          // reads = "gap": the raw number increases with the gap
  std::optional<double> um_per_V;  // required if the log has volts
  std::string scale_record;        // id of the calibration record that contains um_per_V
  double offset_um = 0;            // raw reading at the nominal surface
  // [reading_um, correction_um], ascending; constant beyond the ends.
  std::vector<std::array<double, 2>> linearity;
  std::vector<double> polynomial_um;  // alternative: correction in µm, Σ c_i (reading_um)^i
  // raw_um from, to; default: from range_um and `reads`.
  std::optional<std::array<double, 2>> valid_um;
  // Range of t in which a calibration record has calibrated the probe; nullopt: unknown.
  std::optional<std::array<double, 2>> calibrated_um = std::nullopt;
  std::string certificate;  // number of the calibration certificate
  std::string laboratory;   // laboratory that issued the certificate
  std::string calibrated;   // YYYY-MM-DD
  std::string due;          // YYYY-MM-DD, last day of validity
};

struct Probe {
  std::string id;
  Vec3 position_m{};  // point of M where the probe's line meets the nominal target surface at d = 0
  Vec3 direction{};   // unit vector in M, machine axes: the probe reads displacement along it
  std::string plane;  // id of the target plane that it measures; empty: found from its direction
  double range_m = 0;  // full range; saturated at ±range/2 (a gap probe: at 0 and range)
  Calibration calibration;
  // Delay of its readings against those of the encoder, from the filter of its amplifier.
  double delay_s = 0;
  ProbeUncertainty uncertainty = {};
  // The direction in the rig, if a calibration found another direction. Without [[plane]] the
  // target was made and aligned square to this nominal direction.
  std::optional<Vec3> nominal_direction = {};
};

// Known flatness of a target plane: height above the plane on a grid, bilinear between grid points
// and constant beyond the ends (algo/plausibility/map_cover.h reports where this happens). The
// coordinates are two axes of C, in the order x, y, z without the axis of the normal.
struct HeightMap {
  std::vector<double> first_m, second_m;
  std::vector<double> height_m;  // [first][second], row-major
  bool empty() const { return height_m.empty(); }
};

// A target plane in C: normal · p = offset. A probe measures the plane that it names, otherwise the
// plane whose normal is nearest to its direction, if that is unambiguous.
struct TargetPlane {
  std::string id;
  Vec3 normal{};
  std::optional<double> offset_m;  // default: from the positions of the probes
  HeightMap flatness;
  // Standard uncertainty of its height in addition to the map, and its longest wavelength.
  DeclaredUncertainty u_flatness = {};
  double flatness_length_m = 0.03;
};

struct RigPhysics;  // schema/rig/effects/physics.h

struct Rig {
  std::string name;
  Axis axis = Axis::x;
  std::vector<Probe> probes;
  // [encoder]: micrometres along the axis per volt of an encoder that outputs volts, negative if
  // the voltage decreases with the position. nullopt: such an encoder is rejected.
  std::optional<double> encoder_um_per_V;
  Sides sides;                       // `moves` and `travel`
  Chain machine;                     // [machine]; may be unknown
  std::vector<TargetPlane> planes;   // empty: planes normal to the nominal directions
  std::optional<Vec3> tool_point_m;  // P in M, default reference of tables
  // Square: the angle of the material at the corner of the two faces that the rigs of X and Y
  // measure is 90° + this.
  std::optional<double> artefact_angle_error_rad;
  std::optional<double> u_artefact_angle_rad;  // absent: not declared; 0 is a declaration
  RigUncertainty uncertainty;
  RigExpansion expansion;
  // [drift]: limit for the drift of any probe over a run; a larger drift gives a notice. m/s.
  std::optional<double> drift_limit_m_per_s = std::nullopt;
  // Effects on the readings of capacitance probes, and which of them are corrected. nullptr: the
  // rig declares none.
  std::shared_ptr<const RigPhysics> physics = nullptr;
  ReportFacts report;  // [report]
  // Calibration records of the rig, already applied (schema/rig/calibrated.h).
  std::vector<CalibrationRecord> records;
  std::string text;    // the TOML text with its records, for provenance
  std::string source;  // file name, for messages

  MovingAxis moving() const { return {axis, sides}; }

  std::optional<std::size_t> probe_index(std::string_view id) const;
  // Keys of uncertainty.h that are neither declared nor 0, for a part that the rig has. A budget
  // does not include their contributions.
  std::vector<std::string> undeclared_uncertainties() const;
  bool declares_uncertainty() const;  // any key, for any part
};

// Notices for results measured on this day (YYYY-MM-DD..., UTC): calibrations of probes and records
// that are out of date.
Notices overdue_calibrations(const Rig& rig, std::string_view day);

// Reads a rig (schema/README.md). A rig with calibration records must have them appended, as by
// load_rig_text(). Errors name the file, line and key, and for an unknown key the nearest known
// one.
Result<Rig> parse_rig(std::string_view toml_text, const std::string& source_name);
Result<Rig> load_rig(const std::filesystem::path& file);

}  // namespace mdof
