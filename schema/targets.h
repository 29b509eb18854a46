// Target positions of a run (ISO 230-2:2014, 5.3.2): even intervals, each target shifted by a small
// random amount, so that periodic errors of the scale and the screw are sampled and not hidden.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "schema/base/result.h"
#include "schema/notice/notice.h"

namespace mdof {

struct TargetSpacing {
  double from_mm = 0, to_mm = 60, interval_mm = 5;
  double jitter_mm = 0;  // largest shift of a target, in either direction
  std::int64_t seed = 1;
};

// Checks a spacing. Returns the first invalid key and why: an empty range, more than 10,000
// targets, a jitter of half an interval or more. nullopt: the spacing is valid.
struct WrongKey {
  const char* key;
  std::string why;
};
std::optional<WrongKey> check_spacing(const TargetSpacing& spacing);

// Ascending positions from from_mm to at most to_mm, each shifted by the jitter. The same seed
// gives the same bits. Only for a spacing that check_spacing() accepts.
std::vector<double> spaced_targets_mm(const TargetSpacing& spacing);

// A notice if all intervals are whole periods of the scale (within 1 % of a period), because its
// periodic error is then the same at every target. Period 0: unknown.
std::optional<Notice> scale_period_notice(const std::vector<double>& targets_mm,
                                          double scale_period_um);

}  // namespace mdof
