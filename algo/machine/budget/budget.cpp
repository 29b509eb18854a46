#include "algo/machine/budget/budget.h"

#include <algorithm>
#include <cmath>
#include <string_view>

#include "schema/units.h"

namespace mdof::algo {
namespace {

constexpr double kMostTurn_rad = 0.1, kMostShift_m = 0.01;

std::string name_of(const MachineFrame& frame, std::size_t k, bool of_line) {
  return of_line ? location_name(frame, k) : error_name(frame, k);
}

BudgetCause cause_of(const ErrorSource& source, BudgetModel& model, BudgetStage stage) {
  BudgetCause cause{source.name, source.unit, source.u, source.shape, {}, Eigen::Vector3d::Zero()};
  for (const SourceEffect& effect : source.acts_on) {
    const MachineFrame& frame = model.machine.frames[effect.frame];
    if (stage == BudgetStage::measured &&
        is_measured(model.machine, {effect.frame, effect.k, effect.of_line, {}})) {
      model.replaced.push_back(source.name + " on " + name_of(frame, effect.k, effect.of_line));
      continue;
    }
    cause.effects.push_back(
        {effect.frame, effect.k, effect.of_line, per_unit_at(model.machine, effect, model.at)});
  }
  return cause;
}

constexpr const char* unit_of(std::size_t k) {
  return k < 3 ? "um" : "urad";
}

// Adds part q of FrameValues::u_parts of frame i as one cause, in µm or µrad. The cause has the
// name of error q. It also acts on the following errors that are correlated with error q. So it is
// not the whole uncertainty of error q: add_error_rows() calculates that.
void add_measured_error(BudgetModel& model, std::size_t i, std::size_t q) {
  const auto& parts = model.values[i].u_parts;
  const auto column = static_cast<Eigen::Index>(q);
  const double u = parts(column, column);
  if (u == 0) return;
  BudgetCause cause{error_name(model.machine.frames[i], q),
                    unit_of(q),
                    u * 1e6,
                    SourceShape::normal,
                    {},
                    Eigen::Vector3d::Zero()};
  for (std::size_t k = q; k < kBodyErrors; ++k)
    if (const double by = parts(static_cast<Eigen::Index>(k), column); by != 0)
      cause.effects.push_back({i, k, false, 1e-6 * (by / u)});
  model.causes.push_back(std::move(cause));
}

// Adds one cause with u = 1 for each part that the errors of several bodies have in common.
void add_shared(BudgetModel& model) {
  for (std::size_t p = 0;; ++p) {
    BudgetCause cause{"", "u", 1, SourceShape::normal, {}, Eigen::Vector3d::Zero(), true};
    for (std::size_t i = 0; i < model.values.size(); ++i) {
      const FrameValues& v = model.values[i];
      if (p >= v.shared.size()) continue;
      cause.name = model.machine.frames[i].covariance.shared[p].name;
      for (std::size_t k = 0; k < kBodyErrors; ++k)
        if (v.shared[p][k] != 0) cause.effects.push_back({i, k, false, v.shared[p][k]});
    }
    if (cause.name.empty()) return;
    if (!cause.effects.empty()) model.causes.push_back(std::move(cause));
  }
}

void add_measured(BudgetModel& model) {
  for (std::size_t i = 0; i < model.machine.frames.size(); ++i)
    for (std::size_t k = 0; k < kBodyErrors; ++k) {
      add_measured_error(model, i, k);
      if (const double u = model.values[i].u_location[k]; u != 0)
        model.causes.push_back({location_name(model.machine.frames[i], k),
                                unit_of(k),
                                u * 1e6,
                                SourceShape::normal,
                                {{i, k, true, 1e-6}},
                                Eigen::Vector3d::Zero()});
    }
}

double reach(SourceShape shape) {
  switch (shape) {
    case SourceShape::rectangular:
      return std::sqrt(3.0);
    case SourceShape::triangular:
      return std::sqrt(6.0);
    case SourceShape::u_shaped:
      return std::sqrt(2.0);
    case SourceShape::normal:
      break;
  }
  return 8.5;  // larger than any normally distributed number that is calculated from 52 random bits
}

Status check_sizes(const BudgetModel& model) {
  for (std::size_t i = 0; i < model.machine.frames.size(); ++i)
    for (std::size_t k = 0; k < kBodyErrors; ++k)
      for (const bool of_line : {false, true}) {
        const FrameValues& v = model.values[i];
        double most = std::abs(of_line ? v.location[k] : v.error[k]);
        for (const BudgetCause& cause : model.causes)
          for (const CauseEffect& e : cause.effects) {
            if (e.frame != i || e.k != k || e.of_line != of_line) continue;
            most += std::abs(e.per_unit) * cause.u * reach(cause.shape);
            if (most <= (k < 3 ? kMostShift_m : kMostTurn_rad)) continue;
            return bad_input(
                "source \"" + cause.name + "\": with the standard uncertainty u of this source, " +
                name_of(model.machine.frames[i], k, of_line) +
                " at the commanded position can exceed the limit of " +
                (k < 3 ? "10 mm" : "0.1 rad") +
                "; check the keys \"u\" and \"factor\" of the source and the units of both values");
          }
      }
  return {};
}

bool has_cause(const BudgetModel& model, const MachineFrame& frame, const ErrorDerivative& d) {
  return std::any_of(model.causes.begin(), model.causes.end(), [&](const BudgetCause& cause) {
    return std::any_of(cause.effects.begin(), cause.effects.end(), [&](const CauseEffect& e) {
      return &model.machine.frames[e.frame] == &frame && e.k == d.k && e.of_line == d.of_line;
    });
  });
}

// Two location errors describe one squareness. The squareness is named only once, by the location
// error of the later axis.
void name_not_declared(const std::vector<ErrorDerivative>& all, BudgetModel& model) {
  for (const ErrorDerivative& d : all) {
    const MachineFrame& frame = model.machine.frames[d.frame];
    if (d.d.head<3>().norm() < 1e-12 || has_cause(model, frame, d)) continue;
    if (d.of_line && frame.kind == FrameKind::fixed) continue;
    if (d.of_line && frame.kind == FrameKind::linear) {
      const MachineFrame* other = squareness_partner(model.machine, d);
      if (!other || frame.direction < other->direction || has_cause(model, *other, d)) continue;
    }
    model.not_declared.push_back(name_of(frame, d.k, d.of_line));
  }
}

using Derivatives = std::vector<ErrorDerivative>;

bool acts_on(const CauseEffect& e, const ErrorDerivative& d) {
  return e.frame == d.frame && e.k == d.k && e.of_line == d.of_line;
}

Eigen::Vector3d place_derivative(const Derivatives& all, const CauseEffect& e) {
  for (const ErrorDerivative& d : all)
    if (acts_on(e, d)) return d.d.head<3>();
  return Eigen::Vector3d::Zero();
}

void add_sensitivities(const Derivatives& all, BudgetModel& model) {
  for (BudgetCause& cause : model.causes)
    for (const CauseEffect& e : cause.effects)
      cause.sensitivity += e.per_unit * place_derivative(all, e);
}

// Adds one row for each source. The sources are the first causes.
void add_source_rows(std::size_t sources, BudgetModel& model) {
  for (std::size_t i = 0; i < sources; ++i) {
    BudgetCause& cause = model.causes[i];
    for (CauseEffect& e : cause.effects) e.row = i;
    model.rows.push_back({cause.name, cause.unit, cause.u, cause.shape, cause.sensitivity,
                          cause.contribution_m().squaredNorm()});
  }
}

// Adds one row for each error with a u. u contains all causes that act on the error, except the
// sources.
void add_error_rows(const Derivatives& all, std::size_t sources, BudgetModel& model) {
  for (const ErrorDerivative& d : all) {
    double square = 0;
    for (std::size_t i = sources; i < model.causes.size(); ++i)
      for (CauseEffect& e : model.causes[i].effects) {
        if (!acts_on(e, d)) continue;
        e.row = model.rows.size();
        square += std::pow(e.per_unit * model.causes[i].u, 2);
      }
    if (square == 0) continue;
    model.rows.push_back({name_of(model.machine.frames[d.frame], d.k, d.of_line), unit_of(d.k),
                          std::sqrt(square) * 1e6, SourceShape::normal, 1e-6 * d.d.head<3>(), 0});
  }
}

// Distributes the variance of each cause, except the sources, to the rows of the errors that the
// cause acts on.
void add_variances(const Derivatives& all, std::size_t sources, BudgetModel& model) {
  for (std::size_t i = sources; i < model.causes.size(); ++i) {
    const BudgetCause& cause = model.causes[i];
    const Eigen::Vector3d whole = cause.sensitivity * cause.u;
    for (const CauseEffect& e : cause.effects)
      model.rows[e.row].variance_m2 += whole.dot(place_derivative(all, e) * (e.per_unit * cause.u));
  }
}

double mean_square(const ErrorFunction& f) {
  double sum = 0;
  for (std::size_t i = 0; i < f.forward.size(); ++i) {
    const double value = f.reverse.empty() ? f.forward[i] : (f.forward[i] + f.reverse[i]) / 2;
    const double u = f.u.empty() ? 0 : f.u[i];
    sum += value * value + u * u;
  }
  return sum / static_cast<double>(f.forward.size());
}

// Returns whether the source acts on this error, or on the other location error of this squareness.
bool acts_on_error(const Machine& machine, const SourceEffect& effect, const ErrorDerivative& d) {
  if (effect.k != d.k || effect.of_line != d.of_line) return false;
  return effect.frame == d.frame ||
         (d.of_line && &machine.frames[effect.frame] == squareness_partner(machine, d));
}

// Standard uncertainty of the error by one effect of a source: root mean square over the table of
// the error.
double designed_u(const Machine& machine, const SourceEffect& effect, double u,
                  const ErrorDerivative& d, Command at) {
  const MachineFrame& frame = machine.frames[d.frame];
  const std::size_t axis = std::string_view("XYZABC").find(frame.id);
  const bool has_table =
      !d.of_line && !frame.error[d.k].position.empty() && frame.id.size() == 1 && axis < at.size();
  if (!has_table) return std::abs(per_unit_at(machine, effect, at)) * u;
  double squares = 0;
  for (const double position : frame.error[d.k].position) {
    at[axis] = position;
    squares += std::pow(per_unit_at(machine, effect, at) * u, 2);
  }
  return std::sqrt(squares / static_cast<double>(frame.error[d.k].position.size()));
}

double measured_square(const MachineFrame& frame, std::size_t k, bool of_line) {
  if (!of_line) return mean_square(frame.error[k]);
  const double value = *frame.location[k].value, u = frame.location[k].u.value_or(0);
  return value * value + u * u;
}

}  // namespace

double per_unit_at(const Machine& machine, const SourceEffect& effect, const Command& at) {
  if (effect.factor_per_position == 0) return effect.factor;
  return effect.factor + effect.factor_per_position * command_of(machine.frames[effect.of], at);
}

Result<BudgetModel> budget_model(const Machine& machine, const Command& at,
                                 MachineApproach approach, BudgetStage stage) {
  BudgetModel model{machine, at, {}, {}, {}, {}, {}};
  if (stage == BudgetStage::designed)
    for (MachineFrame& frame : model.machine.frames) {
      frame.error = {};
      frame.covariance = {};
      frame.location = {};
    }
  model.values = values_at(model.machine, at, approach);
  for (const ErrorSource& source : machine.sources) {
    BudgetCause cause = cause_of(source, model, stage);
    if (!cause.effects.empty()) model.causes.push_back(std::move(cause));
  }
  const std::size_t sources = model.causes.size();
  add_measured(model);
  add_shared(model);
  MDOF_CHECK(check_sizes(model));
  const Derivatives all = derivatives(model.machine, at);
  name_not_declared(all, model);
  add_sensitivities(all, model);
  add_source_rows(sources, model);
  add_error_rows(all, sources, model);
  add_variances(all, sources, model);
  return model;
}

Eigen::Vector3d budget_u_m(const BudgetModel& model) {
  Eigen::Vector3d squares = Eigen::Vector3d::Zero();
  for (const BudgetCause& cause : model.causes)
    squares += cause.contribution_m().cwiseProduct(cause.contribution_m());
  return squares.cwiseSqrt();
}

bool has_correlated_rows(const BudgetModel& model) {
  return std::any_of(model.causes.begin(), model.causes.end(), [](const BudgetCause& cause) {
    return std::any_of(cause.effects.begin(), cause.effects.end(),
                       [&](const CauseEffect& e) { return e.row != cause.effects.front().row; });
  });
}

std::vector<MeasuredError> designed_against_measured(const Machine& machine, const Command& at) {
  std::vector<MeasuredError> all;
  for (const ErrorDerivative& d : derivatives(machine, at)) {
    const MachineFrame& frame = machine.frames[d.frame];
    if (!frame.is_known(d.k, d.of_line)) continue;
    MeasuredError e;
    e.name = name_of(frame, d.k, d.of_line);
    e.k = d.k;
    double designed = 0;
    for (const ErrorSource& source : machine.sources)
      for (const SourceEffect& effect : source.acts_on) {
        if (!acts_on_error(machine, effect, d)) continue;
        const double u = designed_u(machine, effect, source.u, d, at);
        designed += u * u;
        e.has_design = true;
      }
    e.designed_u = std::sqrt(designed);
    e.measured_u = std::sqrt(measured_square(frame, d.k, d.of_line));
    const double arm = d.d.head<3>().norm();
    e.designed_effect_m = arm * e.designed_u;
    e.measured_effect_m = arm * e.measured_u;
    all.push_back(e);
  }
  const auto excess = [](const MeasuredError& e) {
    return e.measured_effect_m * e.measured_effect_m - e.designed_effect_m * e.designed_effect_m;
  };
  std::stable_sort(all.begin(), all.end(), [&](const MeasuredError& a, const MeasuredError& b) {
    return excess(a) > excess(b);
  });
  return all;
}

}  // namespace mdof::algo
