// A stored run: the measurement, its recording, the software that evaluated it, and the result. A
// stored run is never changed; a correction is a new run that supersedes the old run.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "schema/axis.h"
#include "schema/notice/notice.h"
#include "schema/plausibility/plausibility.h"
#include "schema/point.h"
#include "schema/rig/reference.h"

namespace mdof {

// All data that are needed to reproduce the result bit by bit.
struct Provenance {
  std::string recording_kind;  // "csv", "recording", "replay" (by mdofd), "imported csv"
  std::string recording_path;  // absolute path
  // SHA-256 of the bytes of the file (csv), or hash of the chain of chunks (recording).
  std::string recording_sha256;
  std::string rig_text;  // rig and calibration as TOML
  std::string model;
  std::string software_version;
  std::string options_json;   // detection options as one JSON object
  std::string configuration;  // text of mdofd.toml for a live run; otherwise empty
};

// partial: the run ended before all requested targets were measured, or most points could not be
// solved; the notices of the run state what is missing. ended: the measurement has ended, but its
// end is not stored yet. Only mdofd uses this state; the database still contains "open".
enum class RunState { open, complete, partial, aborted, failed, ended };
const char* to_string(RunState state);

// A reference line through a straightness series, and the residuals from the line. Slopes are
// relative to the travel of the moving body in M. Therefore they do not depend on the counting
// direction of the encoder.
struct StraightnessFigure {
  std::string error_key;  // "EYX_um"
  std::string approach;   // "forward", "reverse", "mean"
  double slope_least_squares_rad = 0, slope_end_point_rad = 0;
  // Standard uncertainty of the fitted slope, calculated from the residuals. It states how well a
  // line describes the axis; it does not state how well the slope is known.
  double form_rad = 0;
  // Peak to valley, for each of the two lines.
  double straightness_least_squares_m = 0, straightness_end_point_m = 0;
  // Positions of the largest and smallest residual from the least-squares line.
  double peak_position_m = 0, valley_position_m = 0;
};

// Range of an angle error over the travel. The value at the first target is subtracted.
struct AngleFigure {
  std::string error_key;  // "EAX_urad"
  std::string approach;
  double start_rad = 0;  // the value that was subtracted
  double min_rad = 0, max_rad = 0;
};

// Values of the column temperature_C between the first and the last scan of a run.
struct Temperature {
  double mean_C = 0, min_C = 0, max_C = 0;
  bool operator==(const Temperature&) const = default;
};

struct RunHeader {
  std::int64_t id = 0;  // 0: not stored yet
  Axis axis = Axis::x;
  Sides sides;
  StatedAt stated;  // reference point of the errors and the figures
  RunState state = RunState::open;
  bool simulated = false;
  std::string started_utc;  // ISO 8601; see start_known
  // Whether started_utc is the time at which the measurement began. Otherwise it is the day that
  // the rig states, or the time of the evaluation or of the import.
  bool start_known = false;
  std::string note;
  std::optional<std::int64_t> supersedes;
  Provenance provenance;
  std::uint64_t scans = 0, scans_lost = 0;
  Notices notices;
  std::optional<Temperature> temperature;  // nullopt: not measured

  MovingAxis moving() const { return {axis, sides}; }
};

struct Run {
  RunHeader header;
  std::vector<MeasuredPoint> points;
  std::vector<StraightnessFigure> straightness;
  std::vector<AngleFigure> angles;
  // nullopt: the run has no points, or an mdof version without this member stored it.
  std::optional<Plausibility> plausibility;
};

}  // namespace mdof
