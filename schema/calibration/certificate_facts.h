// Facts that the certificate of a laboratory states about a probe in addition to its values: keys
// of the only probe in its calibration record (schema/calibration/record.h), and of [[probe]] in a
// rig.
#pragma once

#include <string>

#include "schema/base/toml/toml_reader.h"
#include "schema/calibration/record.h"

namespace mdof {

// Empty: not stated. Dates are YYYY-MM-DD.
struct CertificateFacts {
  std::string certificate, laboratory, serial_number, calibrated, due;
  double u_linearity_m = 0;  // u of a displacement after the table's correction; 0: unknown
};

CertificateFacts read_certificate(TomlTable& probe);

// Same as record_text(record), for a record of one probe.
std::string record_text(const CalibrationRecord& record, const CertificateFacts& facts);

}  // namespace mdof
