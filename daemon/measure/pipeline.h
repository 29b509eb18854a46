// Raw blocks of one axis -> a run: calibrate, align, find dwells, solve, put in sequence, evaluate.
// The one path for live measuring, replay and the command line, so that all give the same bits.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "algo/model/solver.h"
#include "algo/on_the_fly/target_grid.h"
#include "algo/points/align.h"
#include "algo/points/dwell.h"
#include "algo/sequence/sequence.h"
#include "algo/sequence/sequence_tail.h"
#include "algo/uncertainty/chi_square.h"
#include "daemon/measure/corrections/point_corrections.h"
#include "daemon/measure/points/run_temperature.h"
#include "daemon/measure/points/suspect_encoder.h"
#include "drivers/calibration.h"
#include "schema/base/result.h"
#include "schema/encoder_datum.h"
#include "schema/notice/notice.h"
#include "schema/rig/rig.h"
#include "schema/run.h"
#include "schema/sample.h"

namespace mdof::daemon {

// A run holds no more stops, whose points take some 4 KB of memory each.
inline constexpr std::size_t kMostStops = 50'000;

struct PipelineOptions {
  Model model = Model::rigid;
  algo::AlignOptions align;
  algo::DwellOptions dwell;
  algo::SequenceOptions sequence;
  double stale_s = 0.5;       // an instant older than this is not shown as good
  bool keep_points = true;    // false: for a view without a run
  int repeats = 0;            // a run was asked for so many, both ways; 0: until stopped
  bool remove_drift = false;  // of the errors, where it is significant (algo/drift)
  std::optional<algo::OnTheFlyOptions> on_the_fly;  // replays only: dwells are not looked for
  EncoderDatum datum;                   // of the positions that are pushed: they have it in them
  std::size_t most_stops = kMostStops;  // later ones are counted and left out

  std::string json() const;  // for the provenance
};

// Thread-bound.
class Pipeline {
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
  // The newest instant, calibrated, for the live view; size 0 before the first.
  const FrameBlock& newest() const { return newest_; }
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
  void judge(Run& run) const;
  void add_plausibility(Run& run) const;

  Rig rig_;
  PipelineOptions options_;
  drivers::Calibrator calibrator_;
  algo::Aligner aligner_;
  algo::DwellDetector dwell_;
  algo::Solver solver_;
  PointCorrections corrections_;
  FrameBlock frames_, newest_;
  std::vector<Point> found_;  // as averaged, not corrected
  std::size_t beyond_ = 0;    // stops behind most_stops
  std::size_t taken_ = 0;     // of found_: those that sequence_ was made of
  algo::Sequence sequence_;
  std::optional<algo::SequenceTail> tail_;  // goes on from it
  std::size_t whole_at_ = 0;                // of found_: then the whole is recognised again
  std::uint64_t lost_ = 0;
  std::optional<std::int64_t> begin_ns_, encoder_ns_;  // of the encoder's first and last scan
  SuspectEncoder suspect_;
  std::size_t unplaced_ = 0;  // of found_
  RunTemperature temperature_;
};

}  // namespace mdof::daemon
