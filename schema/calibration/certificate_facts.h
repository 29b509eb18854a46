// Statements of a laboratory's certificate about a probe, in addition to its calibration values.
// They are keys of [[probe]] in a rig, and of the probe in the calibration record of the
// certificate (schema/calibration/record.h), which has one probe only.
#pragma once

#include <string>

#include "schema/base/toml/toml_reader.h"
#include "schema/calibration/record.h"

namespace mdof {

// An empty string: not stated. Dates are YYYY-MM-DD.
struct CertificateFacts {
  std::string certificate, laboratory, serial_number, calibrated, due;
  // Standard uncertainty of the error that remains after the correction with the linearity table;
  // 0: unknown.
  double u_linearity_m = 0;
};

CertificateFacts read_certificate(TomlTable& probe);

// Returns record_text(record) with these facts, for a record of one probe.
std::string record_text(const CalibrationRecord& record, const CertificateFacts& facts);

}  // namespace mdof
