#include "daemon/output/charts/axis.h"

#include <algorithm>
#include <cmath>

#include "daemon/output/charts/labels.h"
#include "daemon/output/charts/style.h"

namespace mdof::charts {
namespace {

constexpr double kLargest = 1e300, kLeastSpan = 1e-290;
constexpr double kFarDecade = 1e150;  // limit on a logarithmic axis, so that ratios do not overflow
constexpr double kLabelGap = 14, kTickDistance = 28;  // px
constexpr int kMostTicks = 10;
constexpr double kLog2Of10 = 3.321928094887362, kLog10Of2 = 0.3010299956639812;

struct TickStep {
  double multiple = 1;  // 1, 2 or 5
  int exponent = 0;
};

TickStep round_up(double step) {
  const int exponent = decimal_exponent(step);
  const double mantissa = step / power_of_ten(exponent);
  for (const double multiple : {1.0, 2.0, 5.0})
    if (mantissa <= multiple * (1 + 1e-12)) return {multiple, exponent};
  return {1.0, exponent + 1};
}

// n · 10^exponent. For a negative exponent the function divides, because 3 / 10 is the double
// nearest to 0.3, but 3 * 0.1 is not.
double decimal(double n, int exponent) {
  return exponent < 0 ? n / power_of_ten(-exponent) : n * power_of_ten(exponent);
}

// The exponent of the power of ten by which all labels are divided: 0 for values of usual size,
// otherwise a multiple of 3.
int common_exponent(double largest) {
  const int exponent = decimal_exponent(largest);
  if (largest == 0 || (exponent >= -3 && exponent < 5)) return 0;
  return exponent - ((exponent % 3) + 3) % 3;
}

Axis with_ticks(const Range& range, int count) {
  Axis axis;
  axis.low = range.low;
  axis.high = range.high;
  axis.exponent = common_exponent(std::max(std::abs(range.low), std::abs(range.high)));
  const TickStep step = round_up(range.span() / count);
  const double width = decimal(step.multiple, step.exponent);
  const int shift = step.exponent - axis.exponent;
  const double last = std::floor(range.high / width + 1e-9);
  for (double i = std::ceil(range.low / width - 1e-9); i <= last; ++i) {
    const double n = i * step.multiple;
    axis.ticks.push_back(
        {decimal(n, step.exponent), fixed_text(decimal(n, shift), std::max(0, -shift))});
  }
  return axis;
}

// log2(x / a) for 0 < a <= x, with an accuracy of 2^-32. The function uses only squares, so that
// the result has the same bits with every mathematics library.
double log2_of_ratio(double x, double a) {
  int exponent = 0;
  double m = 2 * std::frexp(x / a, &exponent);  // 1 <= m < 2
  double log2 = exponent - 1;
  for (double bit = 0.5; bit > 0x1p-33; bit /= 2) {
    m *= m;
    if (m < 2) continue;
    m /= 2;
    log2 += bit;
  }
  return log2;
}

void add_decade(Axis& axis, int exponent, bool fine) {
  for (const int multiple : {1, 2, 5}) {
    const double at = decimal(multiple, exponent);
    if ((multiple > 1 && !fine) || at < axis.low || at > axis.high) continue;
    const std::string times = multiple == 1 ? "" : std::to_string(multiple) + "×";
    axis.ticks.push_back({at, times + power_text(exponent)});
  }
}

}  // namespace

void Range::include(double x) {
  if (!std::isfinite(x)) return;
  x = std::clamp(x, -kLargest, kLargest);
  low = empty ? x : std::min(low, x);
  high = empty ? x : std::max(high, x);
  empty = false;
}

Range padded(const Range& wanted, double fraction) {
  Range range;
  range.include(wanted.low);
  range.include(wanted.high);
  if (wanted.empty || range.empty) return {0, 1, false};
  const double largest = std::max(std::abs(range.low), std::abs(range.high));
  double pad = range.span() * fraction;
  if (!(range.span() > std::max(largest * 1e-12, kLeastSpan)))
    pad = largest * 0.1 > kLeastSpan ? largest * 0.1 : 1.0;
  return {range.low - pad, range.high + pad, false};
}

double Axis::fraction(double x) const {
  if (!(x > low)) return 0;
  if (x >= high) return 1;
  if (logarithmic) return log2_of_ratio(x, low) / log2_of_ratio(high, low);
  return (x - low) / (high - low);
}

double widest_label(const Axis& axis) {
  double widest = 0;
  for (const Tick& tick : axis.ticks) widest = std::max(widest, text_width(tick.label, kTickPx));
  return widest;
}

double round_step(double step) {
  const TickStep rounded = round_up(step);
  return decimal(rounded.multiple, rounded.exponent);
}

Axis horizontal_axis(const Range& drawn, double length_px) {
  const Range range = padded(drawn, 0);
  Axis axis;
  for (int count = kMostTicks; count >= 1; --count) {
    axis = with_ticks(range, count);
    const double apart = length_px * round_step(range.span() / count) / range.span();
    if (widest_label(axis) + kLabelGap <= apart) break;
  }
  return axis;
}

Axis vertical_axis(const Range& range, double length_px) {
  const int count = static_cast<int>(length_px / kTickDistance);
  return with_ticks(padded(range, 0), std::clamp(count, 1, kMostTicks));
}

Axis logarithmic_axis(const Range& range, double length_px) {
  Axis axis;
  axis.logarithmic = true;
  axis.low = std::clamp(range.low, 1 / kFarDecade, kFarDecade);
  axis.high = std::clamp(range.high, axis.low, kFarDecade);
  if (axis.high < 2 * axis.low) {  // the range is too small for a logarithmic axis: extend it
    axis.low /= 2;
    axis.high *= 2;
  }
  const double decades = log2_of_ratio(axis.high, axis.low) / kLog2Of10;
  const double label = text_width("5×10⁸", kTickPx);
  const bool fine = length_px * kLog10Of2 / decades >= label + kLabelGap / 2;
  const int first = decimal_exponent(axis.low), last = decimal_exponent(axis.high);
  const int every = static_cast<int>((label + kLabelGap) * decades / length_px) + 1;
  for (int e = first; e <= last; e += every) add_decade(axis, e, fine);
  return axis;
}

}  // namespace mdof::charts
