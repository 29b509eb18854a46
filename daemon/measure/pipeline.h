// Raw blocks of one axis -> a run: calibrate, align, find dwells, solve, put in sequence, evaluate.
// The one path for live measuring, replay and the command line, so that all give the same bits.
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
  // Refuses a rig that cannot see the five errors, or that the model does not fit.
  static Result<Pipeline> create(const Rig& rig, const PipelineOptions& options);

  // Uses the block up. Error: it cannot be calibrated, or its time goes backwards. Scans of the
  // encoder that are known to be lost for longer than a window of the dwells hide what the axis
  // did.
  Status push(SampleBlock& raw);

  // The points complete so far, in sequence, solved, stated at the fixture. Targets are as far as
  // known until finish().
  const std::vector<MeasuredPoint>& points();
  // The stops that are none of these points, as far as known.
  const std::vector<StopLeftOut>& left_out() const { return sequence_.left_out; }
  // The newest instant, calibrated, for the live view; size 0 before the first.
  const FrameBlock& newest() const { return newest_; }
  // Called with the instants of each push, calibrated, before dwells are looked for.
  void watch(std::function<void(const FrameBlock&)> watcher) { watcher_ = std::move(watcher); }
  bool still() const { return dwell_.still(); }
  bool is_full() const { return found_.size() >= options_.most_stops; }
  std::optional<std::string> waiting_for() const { return aligner_.waiting_for(); }
  // The errors of the target at one instant, stated at the fixture.
  AxisErrors solve_at(double encoder_m, const std::vector<double>& readings_m,
                      const std::vector<double>& u_m) const;
  const algo::Solver& solver() const { return solver_; }

  // End of the data. Fills points, figures, scans and notices of a run, and its state: complete,
  // or partial (completeness.h); the header's identity and provenance are the caller's. Error:
  // nothing was measured, with the reason: the encoder stood still, no dwell was long enough, a
  // probe was at the end of its range throughout.
  Result<Run> finish();

 private:
  Pipeline(Rig rig, PipelineOptions options, algo::Solver solver);
  void find_stops();
  void leave_out_beyond();
  Notice beyond_limit() const;
  void note_break(const SampleBlock& raw);
  Notice not_placed() const;
  std::optional<Notice> never_stops() const;
  void take_points();
  void take_new_points();
  algo::Residuals residuals() const;
  bool moved() const;
  Status explain_nothing() const;
  Status judge_dead_probes(Notices& notices) const;

  algo::DwellDetector dwell_;
  FrameBlock newest_;
  std::function<void(const FrameBlock&)> watcher_;
  std::vector<Point> found_;  // as averaged, not corrected
  std::size_t beyond_ = 0;    // stops behind most_stops
  std::size_t taken_ = 0;     // of found_: those that sequence_ was made of
  algo::Sequence sequence_;
  std::optional<algo::SequenceTail> tail_;  // goes on from it
  std::size_t whole_at_ = 0;                // of found_: then the whole is recognised again
  std::optional<std::int64_t> begin_ns_, encoder_ns_;  // of the encoder's first and last scan
  std::size_t unplaced_ = 0;                           // of found_
};

}  // namespace mdof::daemon
