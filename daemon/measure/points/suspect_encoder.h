// When the encoder was suspect: where it was without power its datum is lost, and a point that was
// measured then has no place.
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
  // A stretch that is shorter, such as a single late reading, is forgotten: it spoils no point.
  explicit SuspectEncoder(double shortest_s) : shortest_s_(shortest_s) {}

  // Raw, as the device gives it.
  void push(const SampleBlock& raw);

  // It was suspect from the point's beginning to its end; at some time between them.
  bool covers(const Point& point) const;
  bool touches(const Point& point) const;
  // That so many points cannot be placed. `from_s`: the first of them, since the beginning of the
  // log.
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
