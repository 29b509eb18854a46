// Takes the scale and the linearity of a probe from the certificate of a laboratory
// (schema/dcc/certificate.h).
//
// mdof takes
//  - the sensitivity S, the only quantity in V/m or m/V: it gives um_per_V, with u(S)/|S|;
//  - the table, the only list with basic_measuredValue r (a length, or a voltage times um_per_V)
//    and basic_measurementError e = r - x, or basic_referenceValue x instead of e. The correction
//    is -e minus the correction at the rig's zero, so the zero does not change. The u of the table
//    is the largest u of the list.
// The certificate must contain at least one of them. If the readings in um contain, within 3 u, the
// change from the rig's um_per_V to the new one, they were read with the rig's um_per_V and are
// converted to the new one. The expanded uncertainty U is divided by the coverage factor that the
// certificate states with it.
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
  Notices taken;      // what was taken, and from where: information
  Notices not_taken;  // what the certificate does not state: information
};

// `result`: name or refType of the dcc:result to read, if a certificate has several (before and
// after an adjustment); empty: all results. Errors name the file and the line: neither sensitivity
// nor table, or two of one kind; a value without uncertainty; a scale that is not the scale of the
// rig's probe (opposite sign, or more than a factor of 2 from its um_per_V); a table whose rows
// contradict each other, or whose corrections contain another scale than the sensitivity.
Result<CertifiedProbe> certified_probe(const Rig& rig, std::size_t probe,
                                       const DccCertificate& certificate,
                                       const std::string& result);

}  // namespace mdof::algo
