#include "algo/on_the_fly/on_the_fly.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <utility>

#include "algo/points/median.h"
#include "algo/sequence/sequence_cycle.h"

namespace mdof::algo {
namespace {

constexpr std::size_t kRowsForStart = 33, kRowsForPeriod = 4097;
constexpr std::size_t kWatchedRows = 16;

std::int64_t median_step_ns(const AxisPass& pass) {
  std::vector<double> steps;
  for (std::size_t i = pass.first + 1; i < std::min(pass.last, pass.first + kRowsForPeriod); ++i)
    steps.push_back(static_cast<double>(pass.frames.time_ns[i] - pass.frames.time_ns[i - 1]));
  return steps.empty() ? 1 : std::max<std::int64_t>(1, std::llround(median_of(std::move(steps))));
}

}  // namespace

OnTheFly::OnTheFly(TargetGrid grid, std::vector<std::string> ids, std::vector<double> range_m,
                   double max_speed_m_s)
    : grid_(std::move(grid)),
      probes_{std::move(ids), std::move(range_m), {}},
      resolution_(probes_.ids.size()),
      places_(max_speed_m_s),
      watch_(probes_.ids.size()) {
  probes_.step_m.resize(probes_.ids.size());
}

// Starts at the median of the first rows, because the first row alone may be wrong. The axis may
// already be moving. So the travel from this median is limited by the largest speed times the time
// of these rows.
void OnTheFly::begin(const FrameBlock& frames) {
  std::vector<double> early;
  std::int64_t passed_ns = 0;
  for (std::size_t i = 0; i < frames.size() && early.size() < kRowsForStart; ++i) {
    passed_ns = frames.time_ns[i] - frames.time_ns.front();
    if (std::isfinite(frames.encoder_m[i])) early.push_back(frames.encoder_m[i]);
  }
  if (early.empty()) return;
  begun_ = true;
  const double middle_m = median_of(std::move(early));
  begin_ns_ = last_ns_ = frames.time_ns.front();
  places_.begin_at(begin_ns_ - passed_ns, middle_m);
  summary_.encoder_min_m = summary_.encoder_max_m = middle_m;
}

Status OnTheFly::push(const FrameBlock& frames) {
  if (!begun_) begin(frames);
  const auto take = [this](const AxisPass& pass) { take_pass(pass); };
  for (std::size_t from = 0; from < frames.size();) {
    const std::size_t to = places_.find_placed_end(frames, from);
    for (std::size_t i = from; i < to; ++i) {
      summary_.encoder_min_m = std::min(summary_.encoder_min_m, frames.encoder_m[i]);
      summary_.encoder_max_m = std::max(summary_.encoder_max_m, frames.encoder_m[i]);
      summary_.gaps += period_ns_ > 0 && frames.time_ns[i] - last_ns_ > kGapPeriods * period_ns_;
      last_ns_ = frames.time_ns[i];
    }
    summary_.scans += to - from;
    jumps_.push(frames, from, to);
    MDOF_CHECK(finder_.push(frames, from, to, take));
    from = places_.find_unplaced_end(frames, to);
    summary_.unplaced = places_.left_out();
  }
  return {};
}

void OnTheFly::flush() {
  jumps_.flush();
  finder_.flush([this](const AxisPass& pass) { take_pass(pass); });
}

void OnTheFly::take_pass(const AxisPass& pass) {
  if (period_ns_ == 0) {
    period_ns_ = median_step_ns(pass);
    summary_.period_s = 1e-9 * static_cast<double>(period_ns_);
    for (std::size_t i = pass.first + 1; i < pass.last; ++i)
      summary_.gaps +=
          pass.frames.time_ns[i] - pass.frames.time_ns[i - 1] > kGapPeriods * period_ns_;
  }
  learn_resolution(pass);
  PassBins bins = bins_of(pass, grid_, probes_, period_ns_);
  watch(pass, bins);
  if (!bins.bins.empty() || !bins.left_out.empty() || bins.too_dense)
    passes_.push_back(std::move(bins));
}

void OnTheFly::learn_resolution(const AxisPass& pass) {
  for (std::size_t i = pass.first; i + kWatchedRows <= pass.last; i += kWatchedRows)
    resolution_.add(pass.frames, i, i + kWatchedRows);
  for (std::size_t k = 0; k < probes_.ids.size(); ++k) probes_.step_m[k] = resolution_.step_m(k);
}

// Looks for frozen probes in each bin, as DwellDetector does in each stop.
void OnTheFly::watch(const AxisPass& pass, const PassBins& bins) {
  auto bin = bins.bins.begin();
  for (std::size_t i = pass.first; i < pass.last; i += kWatchedRows) {
    const std::size_t end = std::min(pass.last, i + kWatchedRows);
    const auto [low, high] = std::minmax(pass.frames.encoder_m[i], pass.frames.encoder_m[end - 1]);
    watch_.take_newest(pass.frames, i, end, low, high);
    for (; bin != bins.bins.end() && bin->last_row <= end; ++bin) {
      for (std::size_t k = 0; k < probes_.ids.size(); ++k) {
        if (std::isnan(bin->point.probe_sd_m[k])) continue;
        RobustMean mean;
        mean.sd = bin->point.probe_sd_m[k];
        watch_.take_stop(k, mean, probes_.step_m[k]);
      }
    }
  }
}

std::vector<TargetGrid::Target> OnTheFly::targets() const {
  std::vector<TargetGrid::Target> kept = grid_.known();
  if (!kept.empty()) return kept;
  std::map<std::int64_t, std::pair<double, std::size_t>> visits;
  std::size_t most = 0;
  for (const PassBins& pass : passes_) {
    for (const BinPoint& bin : pass.bins) {
      auto& [at_m, n] = visits[bin.place];
      at_m = bin.point.position_m;
      most = std::max(most, ++n);
    }
  }
  for (const auto& [place, of] : visits)
    if (2 * of.second >= most) kept.push_back({place, of.first});
  return kept;
}

Sequence OnTheFly::sequence() const {
  Sequence sequence;
  std::map<std::int64_t, int> number;
  for (const TargetGrid::Target& target : targets()) {
    sequence.targets_m.push_back(target.position_m);
    number[target.place] = static_cast<int>(sequence.targets_m.size());
  }
  sequence.targets = static_cast<int>(sequence.targets_m.size());
  std::vector<Point> points;
  std::vector<Visit> visits;
  for (const PassBins& pass : passes_) {
    for (const BinPoint& bin : pass.bins) {
      const auto found = number.find(bin.place);
      if (found == number.end()) {
        sequence.left_out.push_back(
            {bin.point.position_m, bin.point.begin_ns,
             "fewer than half of the passes crossed this position at a steady speed"});
        continue;
      }
      visits.push_back({found->second, pass.direction});
      points.push_back(bin.point);
    }
  }
  if (points.empty()) return sequence;
  watch_.mark(points, probes_.ids);
  const CycleFound cycle = recognise_cycle(visits, sequence.targets);
  sequence.cycle = cycle.cycle;
  sequence.by_passes = cycle.by_passes;
  for (std::size_t i = 0; i < points.size(); ++i) {
    MeasuredPoint p;
    p.target = visits[i].target;
    p.target_m = sequence.targets_m[static_cast<std::size_t>(p.target) - 1];
    p.run = cycle.run[i];
    p.point = std::move(points[i]);
    sequence.runs = std::max(sequence.runs, p.run);
    sequence.points.push_back(std::move(p));
  }
  return sequence;
}

}  // namespace mdof::algo
