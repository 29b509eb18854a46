// Calculates a run from the raw blocks of one axis. The steps are: calibrate, align, find dwells,
// solve, sort, evaluate. Live measurement, replay and the command line use this class, so that
// their results are bit-identical.
#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "algo/points/dwell.h"
#include "algo/sequence/sequence.h"
#include "algo/sequence/sequence_tail.h"
#include "algo/uncertainty/chi_square.h"
#include "daemon/measure/points/run_builder.h"

namespace mdof::daemon {

// Thread-bound.
class Pipeline : RunBuilder {
 public:
  // Error: the rig cannot determine the five errors, or does not fit the model.
  static Result<Pipeline> create(const Rig& rig, const PipelineOptions& options);

  // Takes a block and changes its content. Error: the block cannot be calibrated, or its time
  // decreases. If encoder scans are lost for longer than a dwell window, the current dwell ends at
  // the last scan before the loss.
  Status push(SampleBlock& raw);

  // The points that are complete now, sorted and solved. The fixture is the reference point of
  // their errors. Their targets may still change until finish().
  const std::vector<MeasuredPoint>& points();
  // Stops that were found until now and are not in points().
  const std::vector<StopLeftOut>& left_out() const { return sequence_.left_out; }
  // The newest calibrated frame, for the live view. The block is empty before the first frame.
  const FrameBlock& newest() const { return newest_; }
  // Quality of the newest sample of each probe and, last, of the encoder. The quality of a probe in
  // newest() is at most that of the encoder, because without a position a reading has no use for a
  // point.
  const std::vector<Quality>& newest_quality() const { return newest_quality_; }
  // push() calls `watcher` with the calibrated frames, before it searches dwells.
  void watch(std::function<void(const FrameBlock&)> watcher) { watcher_ = std::move(watcher); }
  // The probes whose reading has stopped changing and is still the same.
  std::vector<algo::FrozenProbe> frozen_now() const;
  bool still() const { return dwell_.still(); }
  bool is_full() const { return found_.size() >= options_.max_stops; }
  std::optional<std::string> waiting_for() const { return aligner_.waiting_for(); }
  // Calculates the errors from the readings of one frame. The reference point of the errors is the
  // fixture.
  AxisErrors solve_at(double encoder_m, const std::vector<double>& readings_m,
                      const std::vector<double>& u_m) const;
  const algo::Solver& solver() const { return solver_; }

  // Call this function after the last block. Returns a run with points, figures, scans and notices.
  // The state of the run is complete or partial (completeness.h). The caller sets the id and the
  // provenance in the header. Error: no point was measured. The message states the cause: the
  // encoder did not move, no dwell was long enough, or a probe was always at the end of its range.
  Result<Run> finish();

 private:
  Pipeline(Rig rig, PipelineOptions options, algo::Solver solver);
  void find_stops();
  void drop_excess_stops();
  Notice excess_stops_notice() const;
  void note_scan_loss(const SampleBlock& raw);
  void note_quality(const SampleBlock& calibrated);
  Notice not_placed() const;
  std::optional<Notice> never_stops() const;
  void take_points();
  void take_new_points();
  algo::Residuals residuals() const;
  bool moved() const;
  Status check_has_points() const;
  Status check_dead_probes(Notices& notices) const;

  algo::DwellDetector dwell_;
  FrameBlock newest_;
  std::function<void(const FrameBlock&)> watcher_;
  std::vector<Point> found_;      // averaged stops without corrections
  std::size_t excess_stops_ = 0;  // number of stops after the limit max_stops
  std::size_t taken_ = 0;         // number of stops of found_ that sequence_ contains
  algo::Sequence sequence_;
  std::optional<algo::SequenceTail> tail_;  // adds single points to sequence_
  std::size_t next_full_recognition_ =
      0;  // at this size of found_, the whole sequence is recognised again
  // Times of the first and the last encoder scan.
  std::optional<std::int64_t> begin_ns_, encoder_ns_;
  std::size_t stops_without_position_ = 0;  // number of stops of found_ without a position
  std::vector<Quality> newest_quality_;     // see newest_quality()
};

}  // namespace mdof::daemon
