// Converts a quantity to a position on paper: ranges, ticks at round numbers and tick labels. Pure.
#pragma once

#include <string>
#include <vector>

namespace mdof::charts {

// The drawn range of a quantity. Non-finite numbers are ignored; magnitudes above 1e300 become
// 1e300, so that no difference overflows.
struct Range {
  double low = 0, high = 0;
  bool empty = true;
  void include(double x);
  double span() const { return high - low; }
};

// Adds `fraction` of the span at both ends. A range with almost no span (a constant) becomes a
// range around its value; an empty range becomes 0 to 1.
Range padded(const Range& wanted, double fraction);

struct Tick {
  double at = 0;
  std::string label;
};

struct Axis {
  double low = 0, high = 1;  // values at the two ends; low < high, and 0 < low on a logarithmic
                             // axis
  bool logarithmic = false;
  int exponent = 0;  // labels are in multiples of 10^exponent
  std::vector<Tick> ticks;

  // 0 at low, 1 at high; values outside the ends are limited to the ends.
  double fraction(double x) const;
};

double widest_label(const Axis& axis);  // px

// The smallest of 1, 2, 5 times a power of ten that is not below `step` > 0.
double round_step(double step);

// Ticks at multiples of round_step, as many as fit without overlapping labels (side by side on a
// horizontal axis, one above the other on a vertical axis). A range without a span is padded.
Axis horizontal_axis(const Range& drawn, double length_px);
Axis vertical_axis(const Range& range, double length_px);
// For values within 1e±150. Ticks at powers of ten, and at 2 and 5 times them if there is space.
Axis logarithmic_axis(const Range& range, double length_px);

}  // namespace mdof::charts
