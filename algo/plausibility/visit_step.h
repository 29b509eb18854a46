// Checks the probes of a run by means of repeated visits. Finds steps of a reading between two
// visits, copied readings, and runs with one visit of each place only.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "schema/notice/notice.h"
#include "schema/point.h"
#include "schema/rig/rig.h"

namespace mdof::algo {

struct VisitStep {
  std::size_t probe = 0;
  std::size_t point = 0;  // first point after the step
  double size_m = 0;
  // Sd of the readings of single visits about the mean of their place, after subtraction of the
  // step.
  double sd_m = 0;
};

// Returns the likeliest single step of each probe, if the step is larger than six times the scatter
// of the readings after its subtraction. The step must also be e¹⁰ times likelier than a smooth
// change (a polynomial of order 6 over time), so that a drift or slow noise is not reported. A
// place is a target and an approach; a place with one visit contains no information about steps.
// visit_steps() finds smaller steps than ProbeWatch finds within dwells (probe/probe_watch.h).
// Probes with a step from ProbeWatch are left out.
std::vector<VisitStep> visit_steps(const Rig& rig, const std::vector<MeasuredPoint>& points);

// Returns notices about steps of visit_steps(), about readings that are exact copies of an earlier
// visit, and about a run with one visit of each place only.
Notices repeat_notices(const Rig& rig, const std::vector<MeasuredPoint>& points);

}  // namespace mdof::algo
