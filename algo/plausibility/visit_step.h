// What the visits of a run show about its probes: steps of a reading between two visits, repeated
// readings, and places with one visit only.
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
  double sd_m = 0;  // sd of single readings about the mean of their place, without the step
};

// The likeliest single step of each probe, if it is six times the scatter of the readings without
// it, and e¹⁰ times likelier than any smooth change (a polynomial of order 6 over time), so that a
// drift or slow noise is not reported. A place is a target with its approach; places with one visit
// show nothing. It finds smaller steps than those within dwells (probe/probe_watch.h); probes with
// such a step are left out.
std::vector<VisitStep> visit_steps(const Rig& rig, const std::vector<MeasuredPoint>& points);

// Empty: nothing looks wrong.
Notices repeat_notices(const Rig& rig, const std::vector<MeasuredPoint>& points);

}  // namespace mdof::algo
