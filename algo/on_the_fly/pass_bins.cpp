#include "algo/on_the_fly/pass_bins.h"

#include <algorithm>
#include <cmath>

#include "algo/on_the_fly/bin_fit.h"
#include "algo/plausibility/resolution.h"
#include "algo/points/flags.h"
#include "algo/points/over_range.h"

namespace mdof::algo {
namespace {

constexpr double kMostUneven = 0.0075;  // rms deviation from a steady motion, as share of a bin
constexpr double kNoiseFactor = 3;
// In resolution steps of the reading; smaller changes are rounding, not spikes.
constexpr double kCoarseSteps = 3.5;
constexpr double kCoarseShare = 1e-4;  // share of the range of the probe

struct Rows {
  std::size_t first = 0, last = 0;
};

// The motion in the rows of a bin.
struct Way {
  double speed_m_s = 0;
  double unsteadiness_m = 0;  // rms deviation of the position from a steady motion
  double noise_m = 0;         // noise of the encoder, from second differences
};

class Binning {
 public:
  Binning(const AxisPass& pass, const TargetGrid& grid, const ProbesOfBins& probes,
          std::int64_t period_ns)
      : frames_(pass.frames),
        pass_(pass),
        half_m_(grid.bin_m() / 2),
        probes_(probes),
        period_ns_(period_ns) {
    for (std::size_t i = pass.first; i < pass.last; ++i)
      place_m_.push_back(median_position(frames_, i));
  }

  double place_m(std::size_t row) const { return place_m_[row - pass_.first]; }

  // Returns the rows of the bin of a target. Call it for the targets in the order of time. The bin
  // begins where the axis first reaches the range of the bin and ends where the axis first leaves
  // this range.
  Rows rows_of(double target_m) {
    const double along = pass_.direction, middle = along * target_m;
    std::size_t first = next_;
    while (first < pass_.last && along * place_m(first) < middle - half_m_) ++first;
    std::size_t last = first;
    while (last < pass_.last && along * place_m(last) <= middle + half_m_) ++last;
    next_ = last;
    return {first, last};
  }

  void take(const TargetGrid::Target& target, PassBins& out) {
    const Rows rows = rows_of(target.position_m);
    const Way way = way_of(rows);
    const BinFault fault = fault_of(rows, way);
    const std::size_t n = rows.last - rows.first;
    if (fault != BinFault::none) {
      const std::size_t at = std::min(rows.first, pass_.last - 1);
      out.left_out.push_back(
          {target.place, target.position_m, frames_.time_ns[at], fault, n, way.speed_m_s});
      return;
    }
    BinPoint bin;
    bin.place = target.place;
    bin.speed_m_s = std::abs(way.speed_m_s);
    bin.last_row = rows.last;
    bin.point = point_of(rows, target.position_m);
    for (std::size_t k = 0; k < probes_.ids.size(); ++k) fit(k, rows, bin);
    out.bins.push_back(std::move(bin));
  }

 private:
  Way way_of(const Rows& rows) const {
    Way way;
    const std::size_t n = rows.last - rows.first;
    if (n < kLeastReadingsPerBin) return way;
    const std::int64_t middle_ns = frames_.time_ns[rows.first + n / 2];
    double st = 0, sx = 0, stt = 0, stx = 0, bend = 0;
    const double from_m = place_m(rows.first);
    const auto at = [&](std::size_t i) {
      return std::pair(1e-9 * static_cast<double>(frames_.time_ns[i] - middle_ns),
                       place_m(i) - from_m);
    };
    for (std::size_t i = rows.first; i < rows.last; ++i) {
      const auto [t, x] = at(i);
      st += t, sx += x, stt += t * t, stx += t * x;
    }
    const auto count = static_cast<double>(n);
    way.speed_m_s = (stx - st * sx / count) / (stt - st * st / count);
    const double level_m = (sx - way.speed_m_s * st) / count;
    double square = 0;
    for (std::size_t i = rows.first; i < rows.last; ++i) {
      const auto [t, x] = at(i);
      const double off = x - level_m - way.speed_m_s * t;
      square += off * off;
      if (i < rows.first + 2) continue;
      const double bent = place_m(i) - 2 * place_m(i - 1) + place_m(i - 2);
      bend += bent * bent;
    }
    way.unsteadiness_m = std::sqrt(square / (count - 2));
    way.noise_m = std::sqrt(bend / (6 * (count - 2)));
    return way;
  }

  BinFault fault_of(const Rows& rows, const Way& way) const {
    const std::size_t n = rows.last - rows.first;
    const auto missing_ns = [&] {
      const std::int64_t passed_ns = frames_.time_ns[rows.last - 1] - frames_.time_ns[rows.first];
      return passed_ns - static_cast<std::int64_t>(n - 1) * period_ns_;
    };
    const bool hole = n > 1 && missing_ns() > static_cast<std::int64_t>(n - 1) * period_ns_;
    if (n < kLeastReadingsPerBin) return hole ? BinFault::gap : BinFault::too_few;
    const double most_m = std::hypot(kMostUneven * 2 * half_m_, kNoiseFactor * way.noise_m);
    if (!(way.unsteadiness_m <= most_m) || !(way.speed_m_s * pass_.direction > 0))
      return BinFault::speed_changes;
    return hole ? BinFault::gap : BinFault::none;
  }

  Point point_of(const Rows& rows, double target_m) const {
    Point point;
    point.begin_ns = frames_.time_ns[rows.first];
    point.end_ns = frames_.time_ns[rows.last - 1];
    point.position_m = target_m;
    point.direction = pass_.direction;
    point.samples = rows.last - rows.first;
    for (std::size_t i = rows.first + 1; i < rows.last; ++i)
      if (frames_.time_ns[i] - frames_.time_ns[i - 1] > kGapPeriods * period_ns_)
        add_flag(point, Flag::gap);
    return point;
  }

  // Fits each sample of the probe once. Interpolated values are not used, because they contain no
  // new information.
  void fit(std::size_t probe, const Rows& rows, BinPoint& bin) {
    const std::string& id = probes_.ids[probe];
    const auto& fresh = frames_.probe_is_new[probe];
    std::size_t usable_rows = 0;
    OverRange over_range;
    place_.clear(), reading_.clear();
    for (std::size_t i = rows.first; i < rows.last; ++i) {
      const Quality q = frames_.quality_at(probe, i);
      const double read_m = frames_.probe_m[probe][i];
      if (q == Quality::over_range) over_range.add(read_m);
      if (!usable(q) || !std::isfinite(read_m)) continue;
      ++usable_rows;
      if (!fresh.empty() && !fresh[i]) continue;
      place_.push_back((place_m(i) - bin.point.position_m) / half_m_);
      reading_.push_back(read_m);
    }
    const std::size_t n = rows.last - rows.first;
    const double step_m = probes_.step_m[probe];
    const double coarse_m = std::max(kCoarseShare * probes_.range_m[probe], kCoarseSteps * step_m);
    const BinFit found = fit_bin(place_, reading_, coarse_m, scratch_);
    const bool lost =
        usable_rows < kLeastReadingsPerBin || 2 * usable_rows < n ||
        is_saturated(over_range, n, found.value, found.sd + std::abs(found.slope) / 6);
    const bool few = found.used < kLeastReadingsPerBin || !std::isfinite(found.value);
    if (over_range.count > 0) add_flag(bin.point, Flag::saturated, id);
    if (lost || few) add_flag(bin.point, lost ? Flag::lost : Flag::slow, id);
    if (!lost && usable_rows + over_range.count < n) add_flag(bin.point, Flag::missing, id);
    if (found.rejected > 0) add_flag(bin.point, Flag::spike, id);
    const bool good = !lost && !few;
    bin.point.probe_m.push_back(good ? found.value : kNaN);
    const double u_m = with_resolution(found.u, found.sd, step_m);
    bin.point.probe_u_m.push_back(
        good ? u_with_over_range(u_m, found.value, found.sd, over_range, n) : kNaN);
    bin.point.probe_sd_m.push_back(good ? found.sd : kNaN);
    bin.slope.push_back(good ? found.slope / half_m_ : kNaN);
  }

  const FrameBlock& frames_;
  const AxisPass& pass_;
  double half_m_;
  const ProbesOfBins& probes_;
  std::int64_t period_ns_;
  std::size_t next_ = pass_.first;
  std::vector<double> place_m_, place_, reading_, scratch_;
};

}  // namespace

PassBins bins_of(const AxisPass& pass, const TargetGrid& grid, const ProbesOfBins& probes,
                 std::int64_t period_ns) {
  PassBins out;
  Binning binning(pass, grid, probes, period_ns);
  out.direction = pass.direction;
  out.begin_ns = pass.frames.time_ns[pass.first];
  out.end_ns = pass.frames.time_ns[pass.last - 1];
  out.from_m = binning.place_m(pass.first);
  out.to_m = binning.place_m(pass.last - 1);
  const auto [low_m, high_m] = std::minmax(out.from_m, out.to_m);
  auto targets = grid.between(low_m, high_m, pass.last - pass.first);
  out.too_dense = targets.empty() &&
                  high_m - low_m > grid.bin_m() * static_cast<double>(pass.last - pass.first);
  if (pass.direction < 0) std::reverse(targets.begin(), targets.end());
  for (const auto& target : targets) binning.take(target, out);
  return out;
}

}  // namespace mdof::algo
