#include "algo/sensitivity/plan/axis.h"

#include <algorithm>
#include <cmath>

#include "schema/base/random.h"
#include "schema/units.h"

namespace mdof::algo {
namespace {

Eigen::Vector3d machine_axis(Axis axis, std::size_t which) {
  Vec3 unit{};
  unit[which] = 1;
  const Vec3 local = to_local(axis, unit);
  return {local[0], local[1], local[2]};
}

Eigen::Vector3d local_axis(std::size_t which) {
  return Eigen::Vector3d::Unit(static_cast<Eigen::Index>(which));
}

void deviate_probe(const QuantityTarget& target, Axis axis, double value, double turns,
                   ProbeDeviation& probe) {
  switch (target.effect) {
    case Effect::probe_shift:
      probe.shift += value * machine_axis(axis, target.axis);
      break;
    case Effect::probe_circle:
      probe.circle_m = value;
      probe.circle_turns = turns;
      break;
    case Effect::probe_tilt:
      probe.tilt_rad = value;
      probe.tilt_turns = turns;
      break;
    case Effect::probe_tilt_about:
      probe.turn += value * machine_axis(axis, target.axis);
      break;
    case Effect::probe_sensitivity:
      probe.gain += value;
      break;
    case Effect::probe_zero:
      probe.zero_m = value;
      break;
    case Effect::probe_drift:
      probe.drift_m = value;
      break;
    default:
      break;
  }
}

void deviate_plane(const DrawnQuantity& q, const DrawnNumbers& numbers, std::size_t j,
                   PlaneDeviation& plane) {
  const double value = numbers.value(q.slot, j);
  if (q.target.effect == Effect::plane_turn) plane.turn += value * local_axis(q.target.axis);
  if (q.target.effect == Effect::plane_map) plane.map_scale = 1 + value;
  if (q.target.effect != Effect::plane_flatness) return;
  plane.flatness_m = value;
  for (std::size_t w = 0; w < kFlatnessWaves; ++w) {
    const double direction = numbers.value(q.slot + 1 + w, j);
    plane.along[w] = sine_of_turns(direction + 0.25);
    plane.across[w] = sine_of_turns(direction);
    plane.phase_turns[w] = numbers.turns(q.slot + 1 + w, j);
  }
}

// Smallest and largest travel that the plan's distribution of travel_mm can have.
std::pair<double, double> travel_range(const StudyPlan& plan) {
  for (const auto& quantity : plan.quantities) {
    if (quantity.name != "travel_mm") continue;
    const Distribution& d = quantity.distribution;
    if (d.kind == Distribution::Kind::constant) return {0, d.centre};
    if (d.kind == Distribution::Kind::empirical) return {d.sample.front(), d.sample.back()};
    if (d.low < d.high) return {d.low, d.high};
    return {d.centre - 2 * d.spread, d.centre + 2 * d.spread};
  }
  return {0, 0};
}

Status check_forward(const StudyPlan& plan, const Fixture& fixture) {
  const bool map = std::any_of(fixture.probes.begin(), fixture.probes.end(),
                               [](const FixtureProbe& p) { return !p.flatness.empty(); });
  if (map && plan.forward == Forward::small_angle)
    return bad_input(plan.source +
                     ": forward = \"small-angle\" cannot use the flatness map of the rig; " +
                     "use forward = \"rigid\"");
  for (const auto& quantity : plan.quantities) {
    const bool fixture_K = quantity.name == "temperature.fixture_K";
    if ((fixture_K && plan.fixture_per_K == 0) ||
        (quantity.name == "temperature.target_K" && plan.target_per_K == 0))
      return bad_input(quantity.where + ": " + quantity.name + " has no effect, because " +
                       (fixture_K ? "fixture" : "target") +
                       "_ppm_per_K in [expansion] is missing or 0; set this key");
    if (quantity.name.ends_with("map_percent") && !map)
      return bad_input(
          quantity.where + ": the rig has no flatness map for " + quantity.name +
          "; add flatness_um to the [[plane]] of the rig, or use a quantity flatness_um instead");
  }
  return {};
}

}  // namespace

// Data of one trial from which its readings are calculated.
struct PlanAxis::Trial {
  const DrawnNumbers& numbers;
  std::size_t j;
  bool mounted;
  TrueErrors truth;
  double travel_m = 0, encoder_offset_m = 0, encoder_scale = 0;
};

Errors5 PlanAxis::TrueErrors::at(double travel_m, double period) const {
  Errors5 local{};
  for (std::size_t e = 0; e < local.size(); ++e)
    local[e] =
        amplitude[e] == 0 ? 0 : amplitude[e] * sine_of_turns(travel_m / period + phase_turns[e]);
  return local;
}

PlanAxis::PlanAxis(Solver solver, PlanDraws draws)
    : solver_(std::move(solver)), draws_(std::move(draws)) {}

Result<PlanAxis> PlanAxis::create(const StudyPlan& plan, const Rig& rig, const std::string& prefix,
                                  bool point, bool series, std::vector<std::string>& causes) {
  auto solver = Solver::create(rig, plan.model);
  if (!solver) return in_context(plan.source + ": rig", solver.error());
  if (rig.sides != Sides{})
    return bad_input(
        plan.source + ": the rig " + rig.source +
        " does not have moves = \"target\" and travel = \"+\", which a plan needs. Use a copy of "
        "the rig without these two keys" +
        (rig.sides.target_travel_m(1) < 0
             ? ", and reverse the sign of travel_mm in the plan: the target of this rig moves "
               "against the encoder, and the effects of rig errors depend on the position of the "
               "target"
             : ". The effects of rig errors then have the same size, because the target of this "
               "rig moves with the encoder"));
  MDOF_CHECK(check_forward(plan, solver->fixture()));
  const std::size_t positions = series ? plan.series_positions : 0;
  MDOF_TRY(PlanDraws draws, PlanDraws::create(plan, rig, prefix, 1 + positions, causes));
  PlanAxis axis(std::move(*solver), std::move(draws));
  axis.forward_ = plan.forward;
  axis.zero_at_start_ = plan.zero_at_start;
  axis.point_ = point;
  axis.positions_ = positions;
  const auto [low_mm, high_mm] = travel_range(plan);
  if (series && !(high_mm > low_mm))
    return bad_input(
        plan.source +
        ": travel_mm must be a range [from, to], because a series needs different positions");
  axis.from_m_ = from_mm(low_mm);
  axis.to_m_ = from_mm(high_mm);
  axis.period_m_ =
      plan.series_period_mm > 0 ? from_mm(plan.series_period_mm) : axis.to_m_ - axis.from_m_;
  axis.flatness_length_m_ = from_mm(plan.flatness_length_mm);
  axis.fixture_per_K_ = plan.fixture_per_K;
  axis.target_per_K_ = plan.target_per_K;
  return axis;
}

Mounting PlanAxis::nominal_mounting() const {
  Mounting mounting;
  mounting.probe.resize(solver_.fixture().probes.size());
  return mounting;
}

void PlanAxis::deviate(const DrawnNumbers& numbers, std::size_t j, Mounting& m,
                       TrueErrors& truth) const {
  std::fill(m.probe.begin(), m.probe.end(), ProbeDeviation{});
  m.part = {};
  m.plane = {};
  m.fixture_expansion = m.target_expansion = 0;
  for (const DrawnQuantity& q : draws_.drawn()) {
    const double value = numbers.value(q.slot, j), turns = numbers.turns(q.slot, j);
    const auto part = static_cast<std::size_t>(q.target.part);
    switch (q.target.effect) {
      case Effect::part_shift:
        m.part[part].shift += value * machine_axis(axis(), q.target.axis);
        break;
      case Effect::part_turn:
        m.part[part].turn += value * local_axis(q.target.axis);
        break;
      case Effect::plane_turn:
      case Effect::plane_flatness:
      case Effect::plane_map:
        deviate_plane(q, numbers, j, m.plane[part]);
        break;
      case Effect::fixture_heat:
        m.fixture_expansion = value * fixture_per_K_;
        break;
      case Effect::target_heat:
        m.target_expansion = value * target_per_K_;
        break;
      case Effect::truth:
        truth.amplitude[q.target.axis] = value;
        truth.phase_turns[q.target.axis] = turns;
        break;
      default:
        deviate_probe(q.target, axis(), value, turns, m.probe[q.target.probe]);
        break;
    }
  }
}

void PlanAxis::read(const Trial& trial, std::size_t reading, MountedFixture& fixture,
                    AxisReadings& out) const {
  const std::size_t j = trial.j, n = out.n;
  const bool point = reading == 0;
  const double share = point || positions_ < 2
                           ? 1
                           : static_cast<double>(reading - 1) / static_cast<double>(positions_ - 1);
  const double travel_m = point ? trial.travel_m : from_m_ + (to_m_ - from_m_) * share;
  const Errors5 truth = point ? trial.truth.amplitude : trial.truth.at(travel_m, period_m_);
  std::array<double, 64> few{};
  std::vector<double> many(out.probes > few.size() ? out.probes : 0);
  const std::span<double> probe_m =
      many.empty() ? std::span(few).first(out.probes) : std::span(many);
  const bool good = trial.mounted && fixture.read(travel_m, truth, share, zero_at_start_, probe_m);
  double encoder_m = travel_m * (1 + trial.encoder_scale) + trial.encoder_offset_m;
  for (const DrawnQuantity& q : draws_.drawn()) {
    if (q.target.effect == Effect::probe_noise)
      probe_m[q.target.probe] += trial.numbers.value(q.slot + reading, j);
    if (q.target.effect == Effect::encoder_noise)
      encoder_m += trial.numbers.value(q.slot + reading, j);
  }
  out.travel_m[reading * n + j] = travel_m;
  out.encoder_m[reading * n + j] = encoder_m;
  for (std::size_t e = 0; e < kErrorCount; ++e) out.truth[out.at(reading, e) + j] = truth[e];
  for (std::size_t k = 0; k < out.probes; ++k)
    out.probe_m[(reading * out.probes + k) * n + j] = good ? probe_m[k] : kNotSolved;
}

void PlanAxis::simulate(const DrawnNumbers& numbers, std::size_t j, MountedFixture& fixture,
                        Mounting& mounting, AxisReadings& out) const {
  Trial trial{numbers, j, false, {}};
  deviate(numbers, j, mounting, trial.truth);
  trial.mounted = fixture.mount(mounting);
  for (const DrawnQuantity& q : draws_.drawn()) {
    const double value = numbers.value(q.slot, j);
    if (q.target.effect == Effect::travel) trial.travel_m = value;
    if (q.target.effect == Effect::encoder_offset) trial.encoder_offset_m = value;
    if (q.target.effect == Effect::encoder_scale) trial.encoder_scale = value;
    if (q.target.effect == Effect::square) out.square_rad[j] = value;
  }
  for (std::size_t r = 0; r <= positions_; ++r)
    if (needed(r)) read(trial, r, fixture, out);
}

void PlanAxis::solve(AxisReadings& out, std::size_t reading) const {
  const std::size_t n = out.n;
  const double* probe = &out.probe_m[reading * out.probes * n];
  const double* encoder = &out.encoder_m[reading * n];
  if (const auto& small = solver_.small_angle()) {
    BatchIn in{encoder, {}};
    BatchOut to{};
    for (std::size_t k = 0; k < 5; ++k) {
      in.reading_m[k] = probe + small->probe[k] * n;
      to.local[k] = &out.estimate[out.at(reading, k)];
    }
    solve_batch(solver_.model(), *small, in, to, n);
    return;
  }
  std::vector<double> readings(out.probes);
  for (std::size_t j = 0; j < n; ++j) {
    for (std::size_t k = 0; k < out.probes; ++k) readings[k] = probe[k * n + j];
    const AxisErrors found = solver_.solve(encoder[j], readings, {});
    for (std::size_t e = 0; e < kErrorCount; ++e)
      out.estimate[out.at(reading, e) + j] = found.valid ? found.local[e] : kNotSolved;
  }
}

void PlanAxis::run(const DrawRequest& request, AxisReadings& out) const {
  const std::size_t readings = 1 + positions_;
  out.n = request.n;
  out.probes = solver_.fixture().probes.size();
  out.truth.resize(readings * kErrorCount * out.n);
  out.estimate.resize(readings * kErrorCount * out.n);
  out.travel_m.resize(readings * out.n);
  out.encoder_m.resize(readings * out.n);
  out.probe_m.resize(readings * out.probes * out.n);
  out.square_rad.assign(out.n, 0.0);
  DrawnNumbers numbers;
  draws_.fill(request, numbers);
  MountedFixture fixture(solver_.fixture(), forward_, flatness_length_m_);
  Mounting mounting = nominal_mounting();
  for (std::size_t j = 0; j < out.n; ++j) simulate(numbers, j, fixture, mounting, out);
  for (std::size_t r = 0; r < readings; ++r)
    if (needed(r)) solve(out, r);
}

}  // namespace mdof::algo
