// The times at which the encoder was suspect. An encoder that was without power has lost its datum,
// so points that were measured then have no position.
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
  // A shorter stretch, such as a single late reading, is ignored.
  explicit SuspectEncoder(double shortest_s) : shortest_s_(shortest_s) {}

  // `raw`: as the device gives it.
  void push(const SampleBlock& raw);

  // Whether the encoder was suspect for all of the point; for any part of it.
  bool covers(const Point& point) const;
  bool touches(const Point& point) const;
  // The notice that this number of points has no position. `from_s`: time of the first one since
  // the beginning of the log.
  Notice left_out(std::size_t points, double from_s) const;

 private:
  struct Stretch {
    std::int64_t begin_ns, end_ns;
  };
  void take(const SampleBlock& raw, const std::vector<Quality>& quality);
  void end_stretch();

  double shortest_s_;
  std::vector<Stretch> stretches_;
  bool now_ = false;
  std::string device_;
};

}  // namespace mdof::daemon
