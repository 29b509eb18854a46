// Target positions of a run (ISO 230-2:2014, 5.3.2): even intervals, each target moved a little at
// random, so that periodic errors of the scale and the screw are sampled and not hidden.
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
  double jitter_mm = 0;  // each target is moved by up to this, either way
  std::int64_t seed = 1;
};

// Why these are no targets, naming the key: a range that is none, more than 10,000 targets, a
// jitter of half an interval or more; nullopt: they are.
struct WrongKey {
  const char* key;
  std::string why;
};
std::optional<WrongKey> check_spacing(const TargetSpacing& spacing);

// Ascending; the first is at from_mm and the last not beyond to_mm, but for the jitter. The same
// bits from the same seed. Only for a spacing that check_spacing() accepts.
std::vector<double> spaced_targets_mm(const TargetSpacing& spacing);

// Where all intervals are whole periods of the scale (within 1 % of a period): its periodic error
// is then the same at every target. A period of 0 is not known.
std::optional<Notice> scale_period_notice(const std::vector<double>& targets_mm,
                                          double scale_period_um);

}  // namespace mdof
