// Axes of plots: converts values to positions, and makes ticks at round numbers with labels. Pure.
#pragma once

#include <string>
#include <vector>

namespace mdof::charts {

// The drawn range of a quantity. include() ignores non-finite numbers and limits values to ±1e300.
// This way no difference of two values overflows.
struct Range {
  double low = 0, high = 0;
  bool empty = true;
  void include(double x);
  double span() const { return high - low; }
};

// Extends the range at both ends by `fraction` of its span. If the span is almost 0, the result is
// a range around the value. An empty range becomes 0 to 1.
Range padded(const Range& wanted, double fraction);

struct Tick {
  double at = 0;
  std::string label;
};

struct Axis {
  double low = 0, high = 1;  // values at the two ends; low < high; on a logarithmic axis 0 < low
  bool logarithmic = false;
  int exponent = 0;  // a label is the value / 10^exponent
  std::vector<Tick> ticks;

  // The position of x on the axis: 0 at `low`, 1 at `high`. An x outside the axis has the position
  // of the nearer end.
  double fraction(double x) const;
};

double widest_label(const Axis& axis);  // px

// Rounds `step` (> 0) up to the next number of the form 1, 2 or 5 times a power of ten.
double round_step(double step);

// Axes with ticks at multiples of a round step. There are as many ticks as have space for their
// labels. A range whose span is 0 is extended.
Axis horizontal_axis(const Range& drawn, double length_px);
Axis vertical_axis(const Range& range, double length_px);
// A logarithmic axis for values from 1e-150 to 1e150. Ticks are at powers of ten and, if there is
// space, also at 2 and 5 times these.
Axis logarithmic_axis(const Range& range, double length_px);

}  // namespace mdof::charts
