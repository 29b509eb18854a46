// Samples of several devices -> frames on the encoder's time line.
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
  // A probe silent for longer than this behind the newest sample is given up for those instants
  // (missing), so that one dead device does not hold up the rest. Longer than any driver waits for
  // a silent device before it gives it up: what comes at all then comes in time, and a replay, in
  // which devices take turns in other portions, gives the same frames.
  double lag_bound_s = 3;
  // Two samples further apart than this have a gap between them: nothing is interpolated into it.
  double max_gap_s = 0.05;
  // Time between the samples of slow channels, as their devices state it: for these a gap begins at
  // two and a half of it, one sample that is late or lost is none.
  std::map<std::string, double> interval_s = {};
  // How much later than the encoder's a probe's readings come, beyond what their time stamps say (a
  // filter, the order of a scan); negative: earlier. A reading is of that much before its stamp.
  // Where any probe has one, a single device's scans are interpolated as well.
  std::map<std::string, double> delay_s = {};

  double gap_s(const std::string& channel) const;
};

// Takes calibrated blocks (Unit::metre). Where one device gives the encoder and all probes, and
// none has a delay, its scans are the frames, bit for bit. Otherwise each probe is interpolated
// linearly between its two samples around the encoder's instant; quality is the worst of the two
// and the encoder's. Where a probe is slower than the encoder, frames say which instants have a new
// sample of its own (probe_fresh): the others repeat what is known. While the encoder is silent,
// probe samples are kept for twice the lag bound and a second: what it sends after that is of later
// instants. Thread-bound.
class Aligner {
 public:
  Aligner(AlignOptions options, std::vector<std::string> probe_ids);

  // Takes the block's columns (they are swapped or moved from). Frames that became complete are
  // appended to `out`; where its time_ns is empty, whatever its other columns hold is given up.
  // Error: time of a channel goes backwards (names channel and times).
  Status push(SampleBlock& block, FrameBlock& out);
  // End of the data: what waits is given out, missing where nothing more came; but the last
  // instants, whose delayed readings would still have come, are left out.
  void flush(FrameBlock& out);

  // The channel that holds up the frames now, if any.
  std::optional<std::string> waiting_for() const;
  std::uint64_t given_up() const { return given_up_; }  // probe values that never came
  // Samples of the probes that wait for the encoder: bounded by the lag bound, not by its silence.
  std::size_t waiting() const;
  // Of probes most of whose values are missing only because their samples come further apart than
  // the gap. By id.
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
    std::int64_t used_ns = INT64_MIN;  // the newest of its samples that is in the frames
    std::int64_t gap_ns = 0, delay_ns = 0;
    std::uint64_t asked = 0, in_gap = 0;  // values, and those in a gap
    std::int64_t shortest_gap_ns = INT64_MAX;
  };

  bool whole(const SampleBlock& block);
  void take_whole(SampleBlock& block, FrameBlock& out);
  void taint(FrameBlock& out, std::size_t before, const SampleBlock& block) const;
  Status enqueue(const SampleBlock& block);
  Status enqueue_channel(const SampleBlock& block, std::size_t channel, Track& track);
  void emit(FrameBlock& out, bool at_end);
  void drop_expired_samples();
  static Reading value_at(Track& track, std::int64_t time_ns);
  static bool has_fresh(Track& track, std::int64_t time_ns);
  void mark_fresh(FrameBlock& out, std::size_t row, std::size_t probe, bool fresh) const;

  AlignOptions options_;
  std::int64_t lag_bound_ns_ = 0;  // with the longest delay in it
  std::int64_t delay_ns_ = 0;      // the longest; 0: none comes later than the encoder
  Track encoder_;
  std::vector<Track> probes_;
  std::vector<int> channel_of_;  // of known_channels_: [probe..., encoder]
  std::vector<Channel> known_channels_;
  std::int64_t newest_ns_ = INT64_MIN;
  std::uint64_t given_up_ = 0;
};

}  // namespace mdof::algo
