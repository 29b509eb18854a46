// Reads the scale and the linearity of a probe from the certificate of a laboratory
// (schema/dcc/certificate.h).
//
// mdof reads
//  - the sensitivity S: the only quantity in V/m or m/V. um_per_V is calculated from S; its
//    relative standard uncertainty is u(S)/|S|.
//  - the table: the only list with basic_measuredValue r (a length, or a voltage times um_per_V)
//    and either basic_measurementError e = r - x or basic_referenceValue x. The correction
//    is -e, shifted so that the correction at the rig's zero is 0. The u of the table is the
//    largest u of the list.
// The certificate must contain the sensitivity or the table. If both exist, the laboratory may have
// calculated the readings in um with the rig's um_per_V. mdof assumes this if the slope of the
// corrections is, within 3 u, the relative change from the rig's um_per_V to the new um_per_V. mdof
// then converts the readings to the new um_per_V. u is the expanded uncertainty U of the
// certificate divided by the coverage factor that the certificate states.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "schema/calibration/certificate_facts.h"
#include "schema/calibration/record.h"
#include "schema/dcc/certificate.h"
#include "schema/notice/notice.h"
#include "schema/rig/rig.h"

namespace mdof::algo {

struct CertifiedProbe {
  CalibratedProbe probe;
  CertificateFacts facts;
  Notices taken;      // values that were read, with their lines in the certificate
  Notices not_taken;  // values that the certificate does not state
};

// `result`: name or refType of the dcc:result to read, if a certificate has several results (before
// and after an adjustment); empty: all results. Errors state the file and the line:
//   - neither a sensitivity nor a table, or two sensitivities, or two tables
//   - a value without uncertainty
//   - um_per_V has another sign than um_per_V of the rig, or differs by more than a factor of 2
//   - the rows of the table contradict each other
//   - the slope of the corrections is neither 0 nor the relative change of um_per_V
Result<CertifiedProbe> certified_probe(const Rig& rig, std::size_t probe,
                                       const DccCertificate& certificate,
                                       const std::string& result);

}  // namespace mdof::algo
