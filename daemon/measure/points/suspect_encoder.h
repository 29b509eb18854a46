// The times at which the quality of the encoder readings was "suspect". An encoder that was without
// power has lost its datum. A point that was measured at such a time has no position.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "schema/notice/notice.h"
#include "schema/point.h"
#include "schema/sample.h"

namespace mdof::daemon {

class SuspectEncoder {
 public:
  // An interval shorter than `shortest_s` is ignored, for example a single late reading.
  explicit SuspectEncoder(double shortest_s) : shortest_s_(shortest_s) {}

  // `raw`: samples before calibration.
  void push(const SampleBlock& raw);

  // covers(): whether the encoder was suspect during the whole point. touches(): whether it was
  // suspect at any time during the point.
  bool covers(const Point& point) const;
  bool touches(const Point& point) const;
  // The notice that some points have no position. `points`: number of these points. `from_s`: time
  // from the beginning of the log to the first of these points.
  Notice left_out(std::size_t points, double from_s) const;

 private:
  struct Stretch {
    std::int64_t begin_ns, end_ns;
  };
  void take(const SampleBlock& raw, const std::vector<Quality>& quality);
  void end_stretch();

  double shortest_s_;
  std::vector<Stretch> suspect_intervals_;
  bool now_ = false;
  std::string device_;
};

}  // namespace mdof::daemon
