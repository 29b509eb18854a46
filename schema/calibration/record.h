// A stored calibration: a TOML file to which a rig refers.
//
//   [[calibration_record]]
//   sha256 = "…"            hash of all bytes after this line, up to the next record or the end
//   id = "mounting-2026-11-23-5c0e8b51"
//   kind = "mounting"       or "sensitivity"
//   …
// When a rig is read, the records to which it refers are appended to the text of the rig, so that
// the text is complete.
#pragma once

#include <array>
#include <cstdint>
#include <limits>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "schema/axis.h"
#include "schema/base/result.h"
#include "schema/base/toml/toml_reader.h"
#include "schema/calibration/covariance.h"

namespace mdof {

// The values that a calibration determined for a probe. Empty: the calibration did not determine
// this value. SI units.
struct CalibratedProbe {
  std::string id;
  std::optional<Vec3> position_m;
  Vec3 u_position_m{};
  std::optional<Vec3> direction;
  double u_direction_rad = 0;
  std::optional<double> offset_um;  // raw reading at the nominal surface
  double u_offset_m = 0;
  std::optional<double> um_per_V;
  std::vector<std::array<double, 2>> linearity;  // pairs as in the rig
  // First and last calibrated reading, in units of the first column of `linearity`.
  std::optional<std::array<double, 2>> calibrated_um;
  double u_sensitivity_1 = 0;
  double sensitivity_freedom = std::numeric_limits<double>::infinity();  // degrees of freedom
};

struct CalibrationRecord {
  std::string id;
  std::string kind;         // "mounting", "sensitivity"
  std::string rig;          // name of the rig
  char axis = 'X';          // axis of the rig
  std::string date;         // YYYY-MM-DD
  std::string valid_until;  // last day of validity
  std::string software;     // software that wrote the record
  struct Source {
    std::string file, sha256;
  };
  std::vector<Source> sources;
  double chi_square = 0;
  std::int64_t freedom = 0;
  std::vector<std::string> not_seen;
  // Mounting: ids of the sensitivity records with which it was calibrated; nullopt: the record is
  // from an older version.
  std::optional<std::vector<std::string>> sensitivities;
  std::optional<Vec3> u_together_m;  // u of the common shift of all probes along X, Y, Z
  std::vector<CalibratedProbe> probes;
  // Covariance of positions, directions and zeros of the probes; empty in records of older
  // versions. The file has lengths in µm and directions in µrad.
  CalibrationCovariance covariance;
};

inline constexpr std::string_view kRecordHead = "[[calibration_record]]";

// Returns the text of the file with a new id and the hash; `record.id` is ignored.
std::string record_text(const CalibrationRecord& record);

// Reads one [[calibration_record]]; errors are recorded in the table.
CalibrationRecord read_record(TomlTable& table);

// Returns the text of each record, from kRecordHead to the next kRecordHead or to the end of the
// text.
std::vector<std::string_view> record_parts(std::string_view text);
// Returns whether the hash of a record is correct for its text.
bool is_unchanged(std::string_view record_part);

}  // namespace mdof
