// What the visits of a run show of its probes: a reading that moved between two visits and stayed
// there, readings that come twice, and places that were visited once.
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
  std::size_t point = 0;  // the first after the step
  double size_m = 0;
  double sd_m = 0;  // of single readings about the mean of their place, without the step
};

// Of each probe the likeliest single step, where it is six times what the readings scatter without
// it and explains them e¹⁰ times better than any smooth change, a polynomial of order 6 over time:
// a drift, or noise that lasts, is none. A place is a target with its approach; those that are
// visited once show nothing. Smaller ones than what a dwell shows (probe/probe_watch.h) are found;
// those that it found are left out.
std::vector<VisitStep> visit_steps(const Rig& rig, const std::vector<MeasuredPoint>& points);

// None: nothing looks wrong.
Notices repeat_notices(const Rig& rig, const std::vector<MeasuredPoint>& points);

}  // namespace mdof::algo
