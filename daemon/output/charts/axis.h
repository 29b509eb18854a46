// From a quantity to a place on paper: ranges, ticks at round numbers and their labels. Pure.
#pragma once

#include <string>
#include <vector>

namespace mdof::charts {

// What of a quantity is drawn. Numbers that are not finite are left out; magnitudes above 1e300
// are taken as 1e300, so that no difference overflows.
struct Range {
  double low = 0, high = 0;
  bool empty = true;
  void include(double x);
  double span() const { return high - low; }
};

// Wider by `fraction` of its span at either end. A range with next to no span (of a constant)
// becomes one around its value; an empty one becomes 0 to 1.
Range padded(const Range& wanted, double fraction);

struct Tick {
  double at = 0;
  std::string label;
};

struct Axis {
  double low = 0, high = 1;  // at its two ends; low < high, and 0 < low on a logarithmic axis
  bool logarithmic = false;
  int exponent = 0;  // labels are in multiples of 10^exponent
  std::vector<Tick> ticks;

  // 0 at low, 1 at high; what is beyond an end is at that end.
  double fraction(double x) const;
};

double widest_label(const Axis& axis);  // px

// The smallest of 1, 2, 5 times a power of ten that is not below `step` > 0.
double round_step(double step);

// Ticks at multiples of round_step, as many as fit without their labels touching: side by side
// along a horizontal axis, one above the other along a vertical one. A range without a span is
// padded.
Axis horizontal_axis(const Range& drawn, double length_px);
Axis vertical_axis(const Range& range, double length_px);
// Of what is within 1e±150. Ticks at powers of ten, and at 2 and 5 times those where there is room.
Axis logarithmic_axis(const Range& range, double length_px);

}  // namespace mdof::charts
