// Converts samples of several devices to frames at the times of the encoder.
#pragma once

#include <array>
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
  // At a sample of the encoder, the aligner waits for the samples of a probe until the newest
  // sample of all channels is later than this encoder sample by more than this time. Then the
  // values of the probe are marked as missing, so that one dead device does not delay the others.
  // The time is longer than the time that any driver waits for a silent device. So late samples are
  // not lost, and a replay gives the same frames although it mixes the samples of the devices in
  // different blocks.
  double lag_bound_s = 3;
  // If the time between two samples is longer than this, it is a gap. Values in a gap are not
  // interpolated. If one device measures the encoder and all probes, a gap is also longer than 2.5
  // of the last sampling intervals (median of nine).
  double max_gap_s = 0.05;
  // Time between two samples of each slow channel, as its device states it. For these channels only
  // a time above 2.5 intervals is a gap, so that one late or lost sample is ignored.
  std::map<std::string, double> interval_s = {};
  // Delay of each probe's readings relative to the readings of the encoder, caused for example by a
  // filter or by the order of channels in a scan. The time stamps do not contain this delay, so it
  // is subtracted from the time stamp of each reading. Negative: the readings are earlier than the
  // encoder's. If any probe has a delay, the scans of a single device are interpolated, too.
  std::map<std::string, double> delay_s = {};

  double gap_s(const std::string& channel) const;
};

// Converts calibrated blocks (Unit::metre) to frames. Thread-bound.
// - If one device measures the encoder and all probes, and no probe has a delay, the scans of the
//   device become the frames without any change.
// - Otherwise each probe is interpolated linearly between its two samples around the time of the
//   encoder. The quality is the worst quality of the two samples and of the encoder's sample.
// - If a probe is slower than the encoder, probe_is_new marks the rows that contain a new sample of
//   the probe. The other rows contain no new information about the probe.
// - If no encoder samples arrive, probe samples are kept for twice the lag bound plus one second.
//   Encoder samples that arrive later do not need older samples of the probes.
class Aligner {
 public:
  Aligner(AlignOptions options, std::vector<std::string> probe_ids);

  // Takes the columns of the block (by swap or move) and appends complete frames to `out`. If
  // out.time_ns is empty, the other columns of `out` are discarded. Error: the time of a channel
  // goes backwards; the error states the channel and the times.
  Status push(SampleBlock& block, FrameBlock& out);
  // Ends the data and appends the pending frames to `out`, with missing values where no sample
  // arrived. The last times are left out if the delayed readings for them have not arrived.
  void flush(FrameBlock& out);

  // The channel for whose samples the aligner waits; empty: it waits for no channel.
  std::optional<std::string> waiting_for() const;
  std::uint64_t given_up() const { return given_up_; }  // missing values of interpolated probes
  // Number of probe samples that wait for samples of the encoder. The lag bound limits this number,
  // also if no encoder samples arrive.
  std::size_t waiting() const;
  // Notices about probes whose values are mostly missing because the time between two samples is
  // longer than the gap. Key: id of the probe.
  std::map<std::string, Notice> too_slow() const;

 private:
  struct Reading {
    std::int64_t time_ns;
    double value;
    Quality quality;
    bool after_gap;  // the time since the previous reading is a gap
  };
  struct Track {
    std::string id;
    std::deque<Reading> readings;
    std::int64_t newest_ns = INT64_MIN;
    std::int64_t used_ns = INT64_MIN;  // time of the newest sample that is in the frames
    std::int64_t gap_ns = 0, delay_ns = 0;
    std::uint64_t asked = 0, in_gap = 0;  // number of values, and number of values in a gap
    std::int64_t shortest_gap_ns = INT64_MAX;
    std::array<std::int64_t, 9> intervals_ns = {};  // the last intervals, in any order
    std::size_t intervals = 0;                      // number of all intervals so far
  };

  bool has_all_channels(const SampleBlock& block);
  void take_whole(SampleBlock& block, FrameBlock& out);
  void limit_probe_quality(FrameBlock& out, std::size_t before, const SampleBlock& block) const;
  Status enqueue(const SampleBlock& block, bool all_channels);
  Status enqueue_channel(const SampleBlock& block, std::size_t channel, Track& track,
                         bool all_channels);
  static bool is_gap(Track& track, std::int64_t interval_ns, bool all_channels);
  void emit(FrameBlock& out, bool at_end);
  void drop_expired_samples();
  static Reading value_at(Track& track, std::int64_t time_ns);
  static bool has_fresh(Track& track, std::int64_t time_ns);
  void mark_fresh(FrameBlock& out, std::size_t row, std::size_t probe, bool fresh) const;

  AlignOptions options_;
  std::int64_t lag_bound_ns_ = 0;  // lag_bound_s plus the longest delay
  std::int64_t delay_ns_ = 0;      // the longest delay; 0: no probe is later than the encoder
  Track encoder_;
  std::vector<Track> probes_;
  std::vector<int> channel_of_;  // index in known_channels_ of each probe and, last, of the encoder
  std::vector<Channel> known_channels_;
  std::int64_t newest_ns_ = INT64_MIN;
  std::uint64_t given_up_ = 0;
};

}  // namespace mdof::algo
