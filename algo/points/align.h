// Converts samples of several devices to frames at the times of the encoder.
#pragma once

#include <cstddef>
#include <cstdint>
#include <deque>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "schema/base/result.h"
#include "schema/notice/notice.h"
#include "schema/sample.h"

namespace mdof::algo {

struct AlignOptions {
  // A probe without samples for longer than this before the newest sample is marked as missing at
  // these times, so that one dead device does not delay the others. The value is longer than any
  // driver waits for a silent device. So late samples arrive in time, and a replay, in which the
  // samples of devices alternate in other portions, gives the same frames.
  double lag_bound_s = 3;
  // Samples further apart than this have a gap between them, and nothing is interpolated in a gap.
  double max_gap_s = 0.05;
  // Time between the samples of slow channels, as their devices state it. For these a gap begins at
  // 2.5 times this interval, so that one late or lost sample is ignored.
  std::map<std::string, double> interval_s = {};
  // Delay of a probe's readings relative to the encoder's, in addition to their time stamps (a
  // filter, the order of a scan); negative: earlier. A reading is assigned to this time before its
  // stamp. If any probe has a delay, the scans of a single device are interpolated, too.
  std::map<std::string, double> delay_s = {};

  double gap_s(const std::string& channel) const;
};

// Takes calibrated blocks (Unit::metre). If one device gives the encoder and all probes, and none
// has a delay, its scans are the frames, bit for bit. Otherwise each probe is interpolated linearly
// between its two samples around the time of the encoder; the quality is the worst of the two and
// the encoder's. If a probe is slower than the encoder, frames mark the times with a new sample of
// the probe (probe_is_new); other times repeat known values. While the encoder is silent, probe
// samples are kept for twice the lag bound plus one second; later samples of the encoder are newer.
// Thread-bound.
class Aligner {
 public:
  Aligner(AlignOptions options, std::vector<std::string> probe_ids);

  // Takes the block's columns (swaps or moves them) and appends complete frames to `out`. If its
  // time_ns is empty, the other columns of `out` are discarded. Error: time of a channel goes
  // backwards (names channel and times).
  Status push(SampleBlock& block, FrameBlock& out);
  // Ends the data and gives the pending frames, with missing values where no sample came. The last
  // times, whose delayed readings are still to come, are left out.
  void flush(FrameBlock& out);

  // The channel that delays the frames now; empty: none.
  std::optional<std::string> waiting_for() const;
  std::uint64_t given_up() const { return given_up_; }  // probe values that never came
  // Probe samples that wait for the encoder; limited by the lag bound, also if the encoder is
  // silent.
  std::size_t waiting() const;
  // Notices of probes most of whose values are missing only because their samples are further apart
  // than the gap, by id.
  std::map<std::string, Notice> too_slow() const;

 private:
  struct Reading {
    std::int64_t time_ns;
    double value;
    Quality quality;
  };
  struct Track {
    std::string id;
    std::deque<Reading> readings;
    std::int64_t newest_ns = INT64_MIN;
    std::int64_t used_ns = INT64_MIN;  // its newest sample in the frames
    std::int64_t gap_ns = 0, delay_ns = 0;
    std::uint64_t asked = 0, in_gap = 0;  // values, and values in a gap
    std::int64_t shortest_gap_ns = INT64_MAX;
  };

  bool whole(const SampleBlock& block);
  void take_whole(SampleBlock& block, FrameBlock& out);
  void limit_probe_quality(FrameBlock& out, std::size_t before, const SampleBlock& block) const;
  Status enqueue(const SampleBlock& block);
  Status enqueue_channel(const SampleBlock& block, std::size_t channel, Track& track);
  void emit(FrameBlock& out, bool at_end);
  void drop_expired_samples();
  static Reading value_at(Track& track, std::int64_t time_ns);
  static bool has_fresh(Track& track, std::int64_t time_ns);
  void mark_fresh(FrameBlock& out, std::size_t row, std::size_t probe, bool fresh) const;

  AlignOptions options_;
  std::int64_t lag_bound_ns_ = 0;  // including the longest delay
  std::int64_t delay_ns_ = 0;      // the longest delay; 0: no probe is later than the encoder
  Track encoder_;
  std::vector<Track> probes_;
  std::vector<int> channel_of_;  // for known_channels_: [probe..., encoder]
  std::vector<Channel> known_channels_;
  std::int64_t newest_ns_ = INT64_MIN;
  std::uint64_t given_up_ = 0;
};

}  // namespace mdof::algo
