// A probe's scale and linearity from the certificate of a laboratory (schema/dcc/certificate.h).
//
// Taken are
//   a sensitivity S, the one quantity in V/m or m/V: um_per_V, and u(S)/|S| as its uncertainty;
//   a table, the one list with basic_measuredValue r (a length, or a voltage times um_per_V) and
//   basic_measurementError e = r - x, or basic_referenceValue x in its place: a correction of -e,
//   less that at the rig's zero, which stays what it is. Its u is the largest one of the list.
// Both or one of them must be there. Readings in um that contain, within 3 u, the change from the
// rig's um_per_V to the new one were read with the rig's, and become those of the new one. U is
// divided by the coverage factor that is stated with it.
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
  Notices taken;      // what was taken from where: information
  Notices not_taken;  // what the certificate leaves open: information
};

// `result`: the name or refType of the dcc:result to read, where a certificate has several (before
// and after an adjustment); empty: all. Errors name file and line: neither sensitivity nor table,
// or two of one kind; one without uncertainty; a scale that is not that of the rig's probe (another
// sign, half or double of its um_per_V); a table whose rows contradict each other, or whose
// corrections contain another scale than the sensitivity.
Result<CertifiedProbe> certified_probe(const Rig& rig, std::size_t probe,
                                       const DccCertificate& certificate,
                                       const std::string& result);

}  // namespace mdof::algo
