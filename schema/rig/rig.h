// The fixture: which probe sits where, looks where, and how its numbers are to be read.
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
  bool reads_gap = false;          // reads = "gap": the raw number grows as the target recedes
  std::optional<double> um_per_V;  // needed where the log has volts
  std::string scale_record;        // id of the calibration record that um_per_V is taken from
  double offset_um = 0;            // raw reading at the nominal surface
  std::vector<std::array<double, 2>>
      linearity;                      // [reading_um, correction_um], ascending; ends held
  std::vector<double> polynomial_um;  // instead: correction in µm, Σ c_i (reading_um)^i
  std::optional<std::array<double, 2>>
      valid_um;  // raw_um from, to; default: from range_um and `reads`
  // t between which a calibration record has calibrated the probe; none: not known.
  std::optional<std::array<double, 2>> calibrated_um = std::nullopt;
  std::string certificate;  // number of the calibration certificate
  std::string laboratory;   // that issued it
  std::string calibrated;   // YYYY-MM-DD
  std::string due;          // YYYY-MM-DD, the last day on which it holds
};

struct Probe {
  std::string id;
  Vec3 position_m{};  // point of M where the probe's line meets the nominal target surface at d = 0
  Vec3 direction{};   // unit vector in M, machine axes: the probe reads displacement along it
  std::string plane;  // id of the target plane it looks at; empty: the one that its direction gives
  double range_m = 0;  // full range; saturated at ±range/2 (a gap probe: at 0 and range)
  Calibration calibration;
  // By how much its readings come later than the encoder's: its amplifier's filter.
  double delay_s = 0;
  ProbeUncertainty uncertainty = {};
  // What the rig states, where a calibration found another direction: without [[plane]] the target
  // was made and set up square to this, not to what was found.
  std::optional<Vec3> nominal_direction = {};
};

// Known flatness of a target plane: height above the plane on a grid, bilinear between, ends held
// (algo/plausibility/map_cover.h says where that happens).
// Coordinates along the plane are two axes of C, in the order x, y, z with the normal's left out.
struct HeightMap {
  std::vector<double> first_m, second_m;
  std::vector<double> height_m;  // [first][second], row-major
  bool empty() const { return height_m.empty(); }
};

// A target plane in C: normal · p = offset. A probe looks at the plane that it names, else at the
// one whose normal is nearest to its direction, where that is unambiguous.
struct TargetPlane {
  std::string id;
  Vec3 normal{};
  std::optional<double> offset_m;  // default: where the probes' positions lie
  HeightMap flatness;
  // Standard uncertainty of its height beside the map, and the longest wave that it is made of.
  DeclaredUncertainty u_flatness = {};
  double flatness_length_m = 0.03;
};

struct RigPhysics;  // schema/rig/effects/physics.h

struct Rig {
  std::string name;
  Axis axis = Axis::x;
  std::vector<Probe> probes;
  // [encoder]: micrometres along the axis for a volt of an encoder that gives volts, negative where
  // the volts fall as it goes on. None: such an encoder is refused.
  std::optional<double> encoder_um_per_V;
  Sides sides;                       // `moves` and `travel`
  Chain machine;                     // [machine]; may be not known
  std::vector<TargetPlane> planes;   // empty: planes normal to the nominal directions
  std::optional<Vec3> tool_point_m;  // P in M at which tables are to hold
  // Of the square: the material encloses 90° + this at the corner of the two faces that the rigs of
  // X and Y look at; with its standard uncertainty.
  std::optional<double> artefact_angle_error_rad;
  std::optional<double> u_artefact_angle_rad;  // absent: not declared; 0 is a declaration
  RigUncertainty uncertainty;
  RigExpansion expansion;
  // [drift]: of any probe's readings over a run; more is a warning of the run. m/s.
  std::optional<double> drift_limit_m_per_s = std::nullopt;
  // What makes a capacitance probe read another gap than there is, and which of it is corrected.
  // None: the rig says nothing of it.
  std::shared_ptr<const RigPhysics> physics = nullptr;
  ReportFacts report;                      // [report]
  std::vector<CalibrationRecord> records;  // that it refers to; applied (schema/rig/calibrated.h)
  std::string text;                        // the TOML itself with its records: provenance
  std::string source;                      // file name, for messages

  MovingAxis moving() const { return {axis, sides}; }

  std::optional<std::size_t> probe_index(std::string_view id) const;
  // Keys of uncertainty.h that are not declared, or 0, for a part that the rig has: what a budget
  // leaves out.
  std::vector<std::string> undeclared_uncertainties() const;
  bool declares_uncertainty() const;  // any of them, of any part
};

// What results measured on this day (YYYY-MM-DD..., UTC) have to say of the probes' calibrations
// and of the records that are out of date.
Notices overdue_calibrations(const Rig& rig, std::string_view day);

// Reads a rig (schema/README.md); of one that refers to calibration records, with them behind it,
// as load_rig_text() gives it. Errors name the file, line and key, and for an unknown key the
// nearest known one.
Result<Rig> parse_rig(std::string_view toml_text, const std::string& source_name);
Result<Rig> load_rig(const std::filesystem::path& file);

}  // namespace mdof
