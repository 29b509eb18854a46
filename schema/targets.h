// Target positions of a run (ISO 230-2:2014, 5.3.2). The intervals are equal, and each target is
// then shifted by a small random amount. Without these shifts, a periodic error of the scale or the
// screw could have the same value at every target and remain hidden.
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

// Checks a spacing. Returns the first invalid key and the reason: the range is empty; there are
// more than 10,000 targets; the jitter is half an interval or more. nullopt: the spacing is valid.
struct WrongKey {
  const char* key;
  std::string why;
};
std::optional<WrongKey> check_spacing(const TargetSpacing& spacing);

// Ascending positions from from_mm to at most to_mm, each shifted by at most the jitter. The same
// seed produces the same bits. Call it only for a spacing that check_spacing() accepts.
std::vector<double> spaced_targets_mm(const TargetSpacing& spacing);

// Returns a notice if all intervals are multiples of the period of the scale (within 1 % of a
// period), because the periodic error of the scale is then equal at all targets. Period 0: unknown.
std::optional<Notice> scale_period_notice(const std::vector<double>& targets_mm,
                                          double scale_period_um);

}  // namespace mdof
