#include "tools/mdof/study/running/run_experiment.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <vector>

#include "algo/iso230/line_fit.h"
#include "algo/model/moving_body.h"
#include "algo/model/restate.h"
#include "algo/sensitivity/plan/axis.h"
#include "algo/sensitivity/plan/experiment_base.h"
#include "daemon/measure/pipeline.h"
#include "drivers/simulator/simulator.h"
#include "schema/units.h"

namespace mdof::tools {
namespace {

constexpr double kNotSolved = std::numeric_limits<double>::quiet_NaN();

// A clock that is always at 0 and never waits, because the result of a trial must not depend on the
// time.
drivers::Clock constant_clock() {
  return {[] { return std::int64_t{0}; }, [](std::int64_t) {}};
}

bool is_noise(Effect effect) {
  return effect == Effect::probe_noise || effect == Effect::encoder_noise;
}

// One trial: makes samples from the perturbed rig, the errors of the axis, and the noise of each
// scan, and evaluates them.
class RunTrial {
 public:
  RunTrial(const algo::PlanAxis& axis, const StudyPlan& plan, const algo::DrawRequest& request)
      : axis_(axis),
        plan_(plan),
        request_(request),
        fixture_(axis.solver().fixture(), plan.forward, axis.flatness_length_m()) {
    algo::DrawnNumbers numbers;
    axis.draws().fill(request, numbers);
    algo::Mounting mounting = axis.nominal_mounting();
    axis.deviate(numbers, 0, mounting, truth_);
    mounted_ = fixture_.mount(mounting);
    for (const auto& q : axis.draws().drawn()) {
      const double value = numbers.value(q.slot, 0);
      if (q.target.effect == Effect::encoder_offset) encoder_offset_m_ = value;
      if (q.target.effect == Effect::encoder_scale) encoder_scale_ = value;
      if (is_noise(q.target.effect)) noise_.push_back(&q);
    }
    const auto& targets_mm = plan.run.targets_mm;
    period_m_ = from_mm(plan.series_period_mm > 0 ? plan.series_period_mm
                                                  : targets_mm.back() - targets_mm.front());
  }

  // The run that the evaluation makes. Error: the trial does not make a run.
  Result<Run> measure() {
    if (!mounted_) return bad_input("an angle exceeds 0.25 rad, the limit of the models");
    MDOF_TRY(auto simulator,
             drivers::Simulator::make("study", plan_.rig, options(), model(), constant_clock()));
    daemon::PipelineOptions settings;
    settings.model = plan_.model;
    for (const double t : plan_.run.targets_mm) settings.sequence.targets_m.push_back(from_mm(t));
    MDOF_TRY(auto pipeline, daemon::Pipeline::create(plan_.rig, settings));
    MDOF_CHECK(simulator->open());
    scans_ = ns_to_s(simulator->machine().motion().cycle_ns()) * plan_.run.rate_hz;
    SampleBlock block;
    for (;;) {
      MDOF_TRY(const auto state, simulator->read(block, std::chrono::milliseconds(0)));
      if (state == drivers::ReadState::end) break;
      read_encoder(block);
      MDOF_CHECK(pipeline.push(block));
    }
    return pipeline.finish();
  }

  // The true errors at the fixture, in the order of error_names(), in m and rad.
  Errors5 true_errors_at_fixture(double travel_m) const {
    AxisErrors truth;
    truth.valid = true;
    truth.local = truth_.at(travel_m, period_m_);
    const MovingAxis moving = plan_.rig.moving();
    truth = algo::restate(algo::errors_of_moving_body(truth, Model::rigid, moving), Model::rigid,
                          moving, travel_m, kAtCarriage, kAtFixture);
    return named_from_local(axis_.axis(), truth.local);
  }

 private:
  drivers::SimulatorOptions options() const {
    drivers::SimulatorOptions o;
    o.rate_hz = plan_.run.rate_hz;
    o.real_time = false;
    o.loop = false;
    o.repeats = 1;
    o.targets_mm = plan_.run.targets_mm;
    o.dwell_s = plan_.run.dwell_s;
    o.speed_mm_s = plan_.run.speed_mm_s;
    o.noise_um = o.encoder_noise_nm = o.encoder_resolution_nm = 0;
    for (const ErrorName& name : error_names(axis_.axis())) {
      const auto local = static_cast<std::size_t>(name.local);
      o.errors.push_back({name.name, to_key_unit(name.sign * truth_.amplitude[local]),
                          to_mm(period_m_), truth_.phase_turns[local], 0, 0});
    }
    return o;
  }

  drivers::ForwardModel model() {
    return [this](double travel_m, const Errors5& local, std::span<double> probe_m) {
      const double course = std::min(1.0, scan_ / scans_);
      if (!fixture_.read(travel_m, local, course, plan_.zero_at_start, probe_m))
        std::fill(probe_m.begin(), probe_m.end(), kNotSolved);
      scan_ += 1;
      for (const auto* q : noise_) {
        if (q->target.effect == Effect::probe_noise)
          probe_m[q->target.probe] +=
              axis_.draws().reading(*q, request_, static_cast<std::uint32_t>(scan_));
      }
    };
  }

  // Replaces the last column, which is the true travel in mm, by the encoder position, which
  // contains the errors of the encoder.
  void read_encoder(SampleBlock& block) {
    for (double& shown_mm : block.value.back()) {
      encoder_scan_ += 1;
      shown_mm = shown_mm * (1 + encoder_scale_) + to_mm(encoder_offset_m_);
      for (const auto* q : noise_) {
        if (q->target.effect == Effect::encoder_noise)
          shown_mm += to_mm(axis_.draws().reading(*q, request_, encoder_scan_));
      }
    }
  }

  const algo::PlanAxis& axis_;
  const StudyPlan& plan_;
  algo::DrawRequest request_;
  algo::MountedFixture fixture_;
  algo::PlanAxis::TrueErrors truth_;
  bool mounted_ = false;
  double period_m_ = 0, encoder_offset_m_ = 0, encoder_scale_ = 0;
  std::vector<const algo::DrawnQuantity*> noise_;
  double scan_ = 0, scans_ = 1;
  std::uint32_t encoder_scan_ = 0;
};

// The largest deviation |measured - true| of one error over all points of a run. kNotSolved if a
// point is not solved.
double worst_of(const StudyPlan& plan, const Run& run, const RunTrial& trial, std::size_t error) {
  double worst = run.points.empty() ? kNotSolved : 0;
  for (const MeasuredPoint& point : run.points) {
    if (!point.errors.valid) return kNotSolved;
    const double travel_m =
        from_mm(plan.run.targets_mm[static_cast<std::size_t>(point.target - 1)]);
    const Errors5 found = named_from_local(plan.rig.axis, point.errors.local);
    worst = std::max(worst, std::abs(found[error] - trial.true_errors_at_fixture(travel_m)[error]));
  }
  return worst;
}

// The deviation of the reported straightness figure (mean of both approaches) from the true figure.
double straightness_of(const StudyPlan& plan, const Run& run, const RunTrial& trial,
                       std::size_t error, bool end_point) {
  const std::string key = error_names(plan.rig.axis)[error].key;
  const auto figure = std::find_if(run.straightness.begin(), run.straightness.end(), [&](auto& f) {
    return f.error_key == key && f.approach == std::string("mean");
  });
  if (figure == run.straightness.end()) return kNotSolved;
  std::vector<double> x, y;
  for (const double t : plan.run.targets_mm) {
    x.push_back(from_mm(t));
    y.push_back(trial.true_errors_at_fixture(x.back())[error]);
  }
  const algo::Line line = end_point ? algo::end_point_line(x, y) : algo::least_squares_line(x, y);
  const double found =
      end_point ? figure->straightness_end_point_m : figure->straightness_least_squares_m;
  return found - algo::deviations_from(line, x, y).peak_to_valley;
}

class RunExperiment final : public algo::PlanExperimentBase {
 public:
  static Result<std::unique_ptr<algo::ScalableExperiment>> create(const StudyPlan& plan) {
    std::unique_ptr<RunExperiment> e(new RunExperiment(plan));
    MDOF_TRY(e->axis_, algo::PlanAxis::create(plan, plan.rig, "", true, false, e->causes_));
    if (auto distinct = algo::check_hashes({&e->axis_->draws()}); !distinct)
      return in_context(plan.source, distinct.error());
    for (const auto& q : e->axis_->draws().drawn()) {
      if (is_noise(q.target.effect) && q.group != algo::kNoCause)
        return bad_input(
            plan.quantities[q.quantity].where + ": " + q.target.name +
            " cannot be correlated, because the noise of each sample is independent if output_of "
            "= \"run\"; remove it from the [[correlation]], or use output_of = \"point\"");
    }
    return std::unique_ptr<algo::ScalableExperiment>(std::move(e));
  }

  std::vector<std::pair<std::string, double>> inputs(std::uint64_t trial) const override {
    return algo::drawn_inputs(axis_->draws(), trial, "");
  }

 private:
  explicit RunExperiment(const StudyPlan& plan) : PlanExperimentBase(plan), plan_(plan) {}

  void run_all(const algo::DrawRequest& request, std::span<double* const> out) const override {
    for (std::size_t j = 0; j < request.n; ++j) {
      algo::DrawRequest one = request;
      one.first = request.first + request.step * j;
      one.n = 1;
      RunTrial trial(*axis_, plan_, one);
      const auto run = trial.measure();
      bool solved = run.has_value();
      for (std::size_t k = 0; solved && k < plan_.outputs.size(); ++k) {
        out[k][j] = to_key_unit(value(plan_.outputs[k], *run, trial));
        solved = std::isfinite(out[k][j]);
      }
      for (std::size_t k = 0; !solved && k < plan_.outputs.size(); ++k) out[k][j] = kNotSolved;
    }
  }

  double value(const PlannedOutput& output, const Run& run, const RunTrial& trial) const {
    if (output.kind == OutputKind::worst) return worst_of(plan_, run, trial, output.error);
    return straightness_of(plan_, run, trial, output.error,
                           output.kind == OutputKind::straightness_ends);
  }

  StudyPlan plan_;
  std::optional<algo::PlanAxis> axis_;
};

}  // namespace

Result<std::unique_ptr<algo::ScalableExperiment>> make_run_experiment(const StudyPlan& plan) {
  return RunExperiment::create(plan);
}

Status check_run_trial(const StudyPlan& plan, std::uint64_t trial) {
  std::vector<std::string> causes;
  MDOF_TRY(const auto axis, algo::PlanAxis::create(plan, plan.rig, "", true, false, causes));
  const auto run = RunTrial(axis, plan, {trial, 1, 1, {}, {}}).measure();
  return run ? Status() : tl::unexpected(run.error());
}

}  // namespace mdof::tools
