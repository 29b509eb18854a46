#include "algo/points/align.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "schema/base/number/number_text.h"
#include "schema/units.h"

namespace mdof::algo {
namespace {

constexpr double kGapIntervals = 2.5;

// If the frame block is empty, its columns may contain old values. The columns are then swapped, so
// that the driver can reuse their memory.
template <class T>
void append_or_take(std::vector<T>& to, std::vector<T>& from, bool empty) {
  if (empty) {
    to.swap(from);
  } else {
    to.insert(to.end(), from.begin(), from.end());
  }
}

void append_quality(std::vector<Quality>& to, std::size_t before, std::vector<Quality>* from,
                    std::size_t n) {
  if (before == 0) to.clear();
  const bool marked = from && !from->empty();
  if (!marked && to.empty()) return;
  to.resize(before, Quality::good);
  if (marked) {
    to.insert(to.end(), from->begin(), from->end());
  } else {
    to.resize(before + n, Quality::good);
  }
}

void clear_columns(FrameBlock& frames) {
  frames.encoder_m.clear();
  for (auto& column : frames.probe_m) column.clear();
  for (auto& column : frames.probe_quality) column.clear();
  for (auto& column : frames.probe_is_new) column.clear();
}

// The quality of a reading is not better than the quality of its position.
void raise_to(std::vector<Quality>& quality, std::size_t before,
              const std::vector<Quality>& least) {
  quality.resize(before + least.size(), Quality::good);
  for (std::size_t i = 0; i < least.size(); ++i)
    quality[before + i] = std::max(quality[before + i], least[i]);
}

std::int64_t to_ns(double s) {
  return static_cast<std::int64_t>(s * 1e9);
}

}  // namespace

double AlignOptions::gap_s(const std::string& channel) const {
  const auto slow = interval_s.find(channel);
  return slow == interval_s.end() ? max_gap_s : std::max(max_gap_s, kGapIntervals * slow->second);
}

Aligner::Aligner(AlignOptions options, std::vector<std::string> probe_ids)
    : options_(std::move(options)) {
  encoder_.id = kEncoderChannel;
  for (auto& id : probe_ids) {
    Track track;
    track.gap_ns = to_ns(options_.gap_s(id));
    if (const auto delay = options_.delay_s.find(id); delay != options_.delay_s.end())
      track.delay_ns = std::llround(delay->second * 1e9);
    delay_ns_ = std::max(delay_ns_, track.delay_ns);
    track.id = std::move(id);
    probes_.push_back(std::move(track));
  }
  lag_bound_ns_ = to_ns(options_.lag_bound_s) + delay_ns_;
}

// Finds the columns of the channels; -1: the channel is missing.
bool Aligner::has_all_channels(const SampleBlock& block) {
  // A block with fewer channels than the rig is from one of several devices.
  if (block.channels.size() <= probes_.size()) return false;
  if (block.channels != known_channels_) {
    known_channels_ = block.channels;
    channel_of_.assign(probes_.size() + 1, -1);
    for (std::size_t c = 0; c < block.channels.size(); ++c) {
      const std::string& id = block.channels[c].id;
      for (std::size_t k = 0; k < probes_.size(); ++k) {
        if (probes_[k].id == id) channel_of_[k] = static_cast<int>(c);
      }
      if (id == encoder_.id) channel_of_.back() = static_cast<int>(c);
    }
  }
  return std::find(channel_of_.begin(), channel_of_.end(), -1) == channel_of_.end();
}

void Aligner::take_whole(SampleBlock& block, FrameBlock& out) {
  const std::size_t before = out.size(), n = block.scans();
  for (std::size_t k = 0; k < probes_.size(); ++k) {
    const auto c = static_cast<std::size_t>(channel_of_[k]);
    append_or_take(out.probe_m[k], block.value[c], before == 0);
    append_quality(out.probe_quality[k], before,
                   block.quality.empty() ? nullptr : &block.quality[c], n);
  }
  for (auto& column : out.probe_is_new) {
    if (before == 0) column.clear();
    if (!column.empty()) column.resize(before + n, 1);
  }
  limit_probe_quality(out, before, block);
  append_or_take(out.encoder_m, block.value[static_cast<std::size_t>(channel_of_.back())],
                 before == 0);
  append_or_take(out.time_ns, block.time_ns, before == 0);
}

// The quality of a probe is not better than the quality of the encoder. Nothing changes if the
// encoder is good, or simulated (then the probes are simulated, too).
void Aligner::limit_probe_quality(FrameBlock& out, std::size_t before,
                                  const SampleBlock& block) const {
  const auto encoder = static_cast<std::size_t>(channel_of_.back());
  if (block.quality.empty() ||
      std::all_of(block.quality[encoder].begin(), block.quality[encoder].end(), usable))
    return;
  for (auto& quality : out.probe_quality) raise_to(quality, before, block.quality[encoder]);
}

Status Aligner::push(SampleBlock& block, FrameBlock& out) {
  out.probe_m.resize(probes_.size());
  out.probe_quality.resize(probes_.size());
  if (block.scans() == 0) return {};
  const bool all_channels = has_all_channels(block);
  // With delays, the readings of a scan have different times.
  if (!all_channels || !options_.delay_s.empty()) {
    if (out.size() == 0) clear_columns(out);
    MDOF_CHECK(enqueue(block, all_channels));
    emit(out, false);
    drop_expired_samples();
    return {};
  }
  if (block.time_ns.front() <= encoder_.newest_ns) {
    return bad_input("device \"" + block.device + "\": the time stamp " +
                     std::to_string(block.time_ns.front()) + " ns follows " +
                     std::to_string(encoder_.newest_ns) + " ns, but the time stamps must increase");
  }
  encoder_.newest_ns = block.time_ns.back();
  take_whole(block, out);
  return {};
}

Status Aligner::enqueue(const SampleBlock& block, bool all_channels) {
  for (std::size_t c = 0; c < block.channels.size(); ++c) {
    Track* track = block.channels[c].id == encoder_.id ? &encoder_ : nullptr;
    for (Track& probe : probes_) {
      if (probe.id == block.channels[c].id) track = &probe;
    }
    if (track) MDOF_CHECK(enqueue_channel(block, c, *track, all_channels));
  }
  newest_ns_ = std::max(newest_ns_, block.time_ns.back());
  return {};
}

bool Aligner::is_gap(Track& track, std::int64_t interval_ns, bool all_channels) {
  track.intervals_ns[track.intervals++ % track.intervals_ns.size()] = interval_ns;
  if (interval_ns <= track.gap_ns || !all_channels) return interval_ns > track.gap_ns;
  auto last = track.intervals_ns;
  const auto n = static_cast<std::ptrdiff_t>(std::min(track.intervals, last.size()));
  std::nth_element(last.begin(), last.begin() + n / 2, last.begin() + n);
  return static_cast<double>(interval_ns) >
         kGapIntervals * static_cast<double>(last[static_cast<std::size_t>(n / 2)]);
}

Status Aligner::enqueue_channel(const SampleBlock& block, std::size_t channel, Track& track,
                                bool all_channels) {
  for (std::size_t i = 0; i < block.scans(); ++i) {
    const std::int64_t t = block.time_ns[i] - track.delay_ns;
    if (t <= track.newest_ns) {
      return bad_input("device \"" + block.device + "\", channel " + track.id +
                       ": the time stamp " + std::to_string(t) + " ns follows " +
                       std::to_string(track.newest_ns) + " ns, but the time stamps must increase");
    }
    const bool after_gap =
        track.newest_ns != INT64_MIN && is_gap(track, t - track.newest_ns, all_channels);
    track.newest_ns = t;
    track.readings.push_back({t, block.value[channel][i], block.quality_at(channel, i), after_gap});
  }
  return {};
}

// Returns the value of a track at a time up to its newest sample. Drops the samples that are not
// necessary for later times.
Aligner::Reading Aligner::value_at(Track& track, std::int64_t time_ns) {
  auto& readings = track.readings;
  ++track.asked;
  while (readings.size() >= 2 && readings[1].time_ns <= time_ns) readings.pop_front();
  const Reading nothing{time_ns, kNaN, Quality::missing, false};
  if (readings.empty() || readings.front().time_ns > time_ns) return nothing;
  const Reading& a = readings.front();
  if (a.time_ns == time_ns) return a;
  if (readings.size() < 2) return nothing;
  const Reading& b = readings[1];
  if (b.after_gap) {
    ++track.in_gap;
    track.shortest_gap_ns = std::min(track.shortest_gap_ns, b.time_ns - a.time_ns);
    return nothing;
  }
  const double share =
      static_cast<double>(time_ns - a.time_ns) / static_cast<double>(b.time_ns - a.time_ns);
  return {time_ns, a.value + (b.value - a.value) * share, std::max(a.quality, b.quality), false};
}

// Returns whether the value at this time contains a new sample of the probe. Call value_at()
// before.
bool Aligner::has_fresh(Track& track, std::int64_t time_ns) {
  const auto& readings = track.readings;
  if (readings.empty()) return true;  // without samples, no sample can be a repetition
  const std::int64_t newest = readings.front().time_ns >= time_ns || readings.size() < 2
                                  ? readings.front().time_ns
                                  : readings[1].time_ns;
  const bool fresh = newest != track.used_ns;
  track.used_ns = newest;
  return fresh;
}

// The column is added at the first row without a new sample, so a probe as fast as the encoder has
// no column.
void Aligner::mark_fresh(FrameBlock& out, std::size_t row, std::size_t probe, bool fresh) const {
  if (out.probe_is_new.size() < probes_.size()) out.probe_is_new.resize(probes_.size());
  auto& column = out.probe_is_new[probe];
  if (fresh && column.empty()) return;
  column.resize(row, 1);
  column.push_back(fresh);
}

void Aligner::emit(FrameBlock& out, bool at_end) {
  while (!encoder_.readings.empty()) {
    const Reading at = encoder_.readings.front();
    const bool overdue = at_end || newest_ns_ - at.time_ns > lag_bound_ns_;
    const bool reached = std::all_of(probes_.begin(), probes_.end(), [&](const Track& probe) {
      return probe.newest_ns >= at.time_ns;
    });
    if (!reached && !overdue) return;
    encoder_.readings.pop_front();
    const std::size_t row = out.size();
    for (std::size_t k = 0; k < probes_.size(); ++k) {
      Reading r = value_at(probes_[k], at.time_ns);
      mark_fresh(out, row, k, has_fresh(probes_[k], at.time_ns));
      r.quality = std::max(r.quality, at.quality);  // the position may have a worse quality
      given_up_ += r.quality == Quality::missing;
      out.probe_m[k].push_back(r.value);
      if (r.quality != Quality::good || !out.probe_quality[k].empty()) {
        out.probe_quality[k].resize(row, Quality::good);
        out.probe_quality[k].push_back(r.quality);
      }
    }
    out.time_ns.push_back(at.time_ns);
    out.encoder_m.push_back(at.value);
  }
}

// While encoder positions wait, emit() drops the samples that are no longer needed.
void Aligner::drop_expired_samples() {
  if (!encoder_.readings.empty()) return;
  const std::int64_t oldest_ns = newest_ns_ - 2 * lag_bound_ns_ - to_ns(1);
  for (Track& probe : probes_) {
    auto& readings = probe.readings;
    while (readings.size() >= 2 && readings[1].time_ns <= oldest_ns) readings.pop_front();
  }
}

std::size_t Aligner::waiting() const {
  std::size_t n = 0;
  for (const Track& probe : probes_) n += probe.readings.size();
  return n;
}

std::map<std::string, Notice> Aligner::too_slow() const {
  std::map<std::string, Notice> all;
  for (const Track& probe : probes_) {
    if (2 * probe.in_gap <= probe.asked) continue;
    const double apart_s = ns_to_s(probe.shortest_gap_ns);
    all[probe.id] = notice(NoticeCode::probe_too_slow, probe.id,
                           {{"missing", probe.in_gap},
                            {"values", probe.asked},
                            {"apart_s", apart_s},
                            {"max_gap_s", ns_to_s(probe.gap_ns)},
                            {"needed_gap_s", kGapIntervals * apart_s}});
  }
  return all;
}

void Aligner::flush(FrameBlock& out) {
  out.probe_m.resize(probes_.size());
  out.probe_quality.resize(probes_.size());
  if (out.size() == 0) clear_columns(out);
  auto& waits = encoder_.readings;
  while (delay_ns_ > 0 && !waits.empty() && waits.back().time_ns > newest_ns_ - delay_ns_)
    waits.pop_back();
  emit(out, true);
}

std::optional<std::string> Aligner::waiting_for() const {
  if (encoder_.readings.empty()) {
    const bool silent =
        newest_ns_ > encoder_.newest_ns &&
        (encoder_.newest_ns == INT64_MIN || newest_ns_ - encoder_.newest_ns > lag_bound_ns_);
    return silent ? std::optional(encoder_.id) : std::nullopt;
  }
  const auto latest =
      std::min_element(probes_.begin(), probes_.end(),
                       [](const Track& a, const Track& b) { return a.newest_ns < b.newest_ns; });
  return latest->newest_ns < encoder_.readings.front().time_ns ? std::optional(latest->id)
                                                               : std::nullopt;
}

}  // namespace mdof::algo
