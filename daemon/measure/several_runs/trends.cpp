#include "daemon/measure/several_runs/trends.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <set>
#include <tuple>
#include <utility>

#include "algo/uncertainty/budget/budget.h"
#include "daemon/measure/budgets.h"
#include "daemon/measure/evaluation.h"
#include "daemon/measure/gate/gate.h"
#include "daemon/words/error_text.h"
#include "schema/imported/series.h"
#include "schema/recording/run_options.h"
#include "schema/rig/report_facts.h"
#include "schema/units.h"

namespace mdof::daemon {
namespace {

constexpr std::int64_t kRunsPage = 500;
constexpr std::array kAxes = {Axis::x, Axis::y, Axis::z};

std::string figure_of(AxisPair axes) {
  return std::string(squareness_name(axes)) + "_urad";
}

// Text of model, options and rig. All runs of one chart must have the same text.
std::string kind_of(const RunHeader& run) {
  const RunOptions options = run_options(run);
  return run.provenance.model + (options.remove_drift ? " without drift " : " ") +
         (options.on_the_fly ? "on the fly " : "") + run.provenance.rig_text;
}

// "4, 5 and 2 more"
std::string listed(const std::vector<std::int64_t>& runs) {
  constexpr std::size_t kNamed = 8;
  std::string text;
  for (std::size_t i = 0; i < std::min(runs.size(), kNamed); ++i)
    text += (i == 0 ? "" : ", ") + std::to_string(runs[i]);
  if (runs.size() > kNamed) text += " and " + std::to_string(runs.size() - kNamed) + " more";
  return text;
}

void leave_out(std::vector<std::string>& sentences, const std::vector<std::int64_t>& runs,
               const std::string& why) {
  if (runs.empty()) return;
  sentences.push_back((runs.size() == 1 ? "run " : "runs ") + listed(runs) + ": " + why);
}

bool earlier(const RunHeader& a, const RunHeader& b) {
  return std::pair(a.started_utc, a.id) < std::pair(b.started_utc, b.id);
}

struct Chosen {
  // In the order of time. rig_text is result_content() of the rig.
  std::vector<RunHeader> runs;
  std::vector<std::string> left_out;
  Notices notices;
};

// A chart with many runs would show hundreds of inherited notices, so one notice has their codes.
void report_doubtful(Chosen& chosen) {
  std::vector<std::int64_t> doubtful;
  std::set<std::string> codes;
  for (const RunHeader& run : chosen.runs) {
    const Notices notices = without_information(run.notices);
    if (!notices.empty()) doubtful.push_back(run.id);
    for (const Notice& n : notices) codes.insert(to_string(n.code));
  }
  if (doubtful.empty()) return;
  std::string names;
  for (const std::string& code : codes) names += (names.empty() ? "" : ", ") + code;
  chosen.notices.push_back(
      notice(NoticeCode::trend_of_doubtful_runs, "",
             {{"runs", doubtful.size()}, {"ids", listed(doubtful)}, {"codes", names}}));
}

// Among the runs with the rig of the newest run: the newest run whose kind has enough runs for a
// chart. If no kind has enough runs: the newest run. The chart therefore does not disappear after a
// single run on the fly, or a single run with another model.
const RunHeader& newest_charted_run(const std::vector<RunHeader>& runs) {
  std::map<std::string, std::size_t> count;
  for (const RunHeader& run : runs) ++count[kind_of(run)];
  const std::string& rig = runs.back().provenance.rig_text;
  for (auto run = runs.rbegin(); run != runs.rend(); ++run)
    if (run->provenance.rig_text == rig && count[kind_of(*run)] > algo::kLeastBaselineValues)
      return *run;
  return runs.back();
}

// Removes the runs of other kinds, unless `mixed` is true.
void choose_kind(Chosen& chosen, bool mixed) {
  if (chosen.runs.empty()) return;
  const RunHeader newest_of_kind = newest_charted_run(chosen.runs);
  const std::string kind = kind_of(newest_of_kind);
  std::vector<std::int64_t> others;
  for (const RunHeader& run : chosen.runs)
    if (kind_of(run) != kind) others.push_back(run.id);
  const std::string newest = "run " + std::to_string(newest_of_kind.id);
  if (mixed) {
    if (!others.empty())
      chosen.notices.push_back(notice(NoticeCode::rigs_mixed, "",
                                      {{"runs", others.size()}, {"run", newest_of_kind.id}}));
    return;
  }
  leave_out(chosen.left_out, others,
            "the rig, the model or an option of the evaluation (drift removal, on the fly) differs "
            "from " +
                newest + " (" + words::remedy(Remedy::mix_runs) + ")");
  std::erase_if(chosen.runs, [&](const RunHeader& run) { return kind_of(run) != kind; });
}

Result<Chosen> choose(store::Store& store, Axis axis, const TrendRequest& request) {
  const bool mixed = request.mixed;
  Chosen chosen;
  std::vector<std::int64_t> simulated, partial, invalid, superseded, again, imported, unwanted;
  std::set<std::string> recordings;
  std::map<std::string, std::string> contents;  // of the rigs
  for (std::int64_t offset = 0;; offset += kRunsPage) {
    MDOF_TRY(const auto page, store.list_runs(offset, kRunsPage, axis));  // newest first
    for (RunHeader run : page) {
      std::string& rig = run.provenance.rig_text;
      if (!contents.contains(rig)) contents[rig] = result_content(rig);
      rig = contents[rig];
      MDOF_TRY(const auto by, store.superseded_by(run.id));
      std::string recording = run.provenance.recording_sha256;
      // Use one run for each recording and kind. If `mixed` is true, use one run for each
      // recording.
      if (!recording.empty() && !mixed) recording += kind_of(run);
      if (is_imported(run))
        imported.push_back(run.id);
      else if (by)
        superseded.push_back(run.id);
      else if (run.simulated)
        simulated.push_back(run.id);
      else if (run.state != RunState::complete)
        partial.push_back(run.id);
      else if (is_invalid(run))
        invalid.push_back(run.id);
      else if (!recording.empty() && !recordings.insert(recording).second)
        again.push_back(run.id);
      else if (std::count(request.without.begin(), request.without.end(), run.id) > 0)
        unwanted.push_back(run.id);
      else
        chosen.runs.push_back(std::move(run));
    }
    if (static_cast<std::int64_t>(page.size()) < kRunsPage) break;
  }
  leave_out(chosen.left_out, imported, "trends do not include imported runs");
  leave_out(chosen.left_out, simulated, "simulated");
  leave_out(chosen.left_out, partial, "not complete");
  leave_out(chosen.left_out, invalid, "marked as invalid by a notice");
  leave_out(chosen.left_out, superseded, "superseded");
  leave_out(chosen.left_out, again, "the database has a newer run of the same recording");
  leave_out(chosen.left_out, unwanted, "left out on request");
  std::sort(chosen.runs.begin(), chosen.runs.end(), earlier);
  choose_kind(chosen, mixed);
  report_doubtful(chosen);
  const auto undated = std::count_if(
      chosen.runs.begin(), chosen.runs.end(),
      [](const RunHeader& run) { return !run.start_known && !is_date(run.started_utc); });
  if (undated > 1)
    chosen.notices.push_back(notice(NoticeCode::order_of_evaluation, "", {{"runs", undated}}));
  return chosen;
}

void add_value(Trend& trend, std::vector<std::int64_t> runs, const std::string& started_utc,
               const Budget& budget, bool u_is_known) {
  trend.values.push_back({std::move(runs), started_utc, budget});
  Budget& stated = trend.values.back().stated;
  stated.lines.clear();
  if (!u_is_known) stated.u = stated.U = stated.freedom = stated.coverage_factor = std::nan("");
  // u_covers contains only contributions that u of every value includes.
  const bool is_first = trend.values.size() == 1;
  if (is_first || budget.noise_only) trend.u_covers = covers(budget);
  const NoiseOnly own = noise_only_if(budget.noise_only);
  trend.noise_only = is_first ? own : joined(trend.noise_only, own);
  for (const std::string& key : budget.not_declared)
    if (std::find(trend.u_not_declared.begin(), trend.u_not_declared.end(), key) ==
        trend.u_not_declared.end())
      trend.u_not_declared.push_back(key);
}

// The values with u_random, but without trials for U, which take seconds for thousands of targets.
std::vector<Budget> without_U(const algo::RunBudgets& noise,
                              const std::vector<algo::Figure>& figures) {
  std::vector<Budget> budgets;
  for (const algo::Figure& figure : figures) budgets.push_back(noise.first_order(figure));
  return budgets;
}

// Adds the values of all requested figures of one run. The run is read only once.
Status add_run(store::Store& store, const RunHeader& header, std::vector<Trend>& trends,
               const std::vector<algo::Figure>& figures) {
  MDOF_TRY(const Run run, restated_run(store, header.id, Reference::fixture));
  MDOF_TRY(const Rig rig, rig_of(run.header));
  const auto whole = algo::RunBudgets::create(rig, run);
  const Status known = whole ? check_cost(*whole) : Status(tl::unexpected(whole.error()));
  const std::string run_name = "run " + std::to_string(header.id);
  const std::vector<Budget> budgets =
      known ? whole->of(figures) : without_U(algo::RunBudgets(rig, run), figures);
  for (std::size_t f = 0; f < figures.size(); ++f) {
    const Budget& budget = budgets[f];
    if (!known)
      trends[f].notices.push_back(inherited(
          run_name, notice(NoticeCode::u_unknown, "", {{"reason", words::text(known.error())}})));
    if (std::isfinite(budget.value))
      add_value(trends[f], {header.id}, header.started_utc, budget, known.has_value());
    else
      leave_out(trends[f].left_out, {header.id},
                "too few targets have error values for this figure");
  }
  return {};
}

Status add_axis(store::Store& store, Axis axis, const TrendRequest& request,
                std::vector<Trend>& out) {
  std::vector<algo::Figure> figures = algo::figures_of_run(axis);
  if (!request.figure.empty())
    std::erase_if(figures, [&](const auto& figure) { return figure.name != request.figure; });
  if (figures.empty()) return {};
  MDOF_TRY(const Chosen chosen, choose(store, axis, request));
  std::vector<Trend> of_axis;
  for (const algo::Figure& figure : figures)
    of_axis.push_back(
        {figure.name, 0, {}, {}, chosen.left_out, chosen.notices, {}, NoiseOnly::none, {}});
  for (const RunHeader& run : chosen.runs) MDOF_CHECK(add_run(store, run, of_axis, figures));
  for (Trend& trend : of_axis)
    if (!trend.values.empty() || !request.figure.empty() || request.axis)
      out.push_back(std::move(trend));
  return {};
}

// Uses the newest squareness fit of each pair of runs that a chart may contain.
Status add_squareness(store::Store& store, AxisPair axes, const TrendRequest& request,
                      std::vector<Trend>& out) {
  MDOF_TRY(const Chosen a, choose(store, axes.a, request));
  MDOF_TRY(const Chosen b, choose(store, axes.b, request));
  std::map<std::int64_t, const RunHeader*> allowed;
  for (const auto* chosen : {&a, &b})
    for (const RunHeader& run : chosen->runs) allowed[run.id] = &run;
  Trend trend{figure_of(axes), 0, {}, {}, {}, {}, {}, NoiseOnly::none, {}};
  std::vector<Squareness> fits;
  for (const auto* chosen : {&a, &b}) {
    trend.left_out.insert(trend.left_out.end(), chosen->left_out.begin(), chosen->left_out.end());
    append(trend.notices, chosen->notices);
  }
  std::set<std::pair<std::int64_t, std::int64_t>> seen;
  std::optional<SquareArtefact> artefact;
  std::vector<std::int64_t> others;
  for (std::int64_t offset = 0;; offset += kRunsPage) {
    MDOF_TRY(const auto page, store.list_squareness(offset, kRunsPage));  // newest first
    for (const Squareness& s : page) {
      if (!allowed.contains(s.run_a) || !allowed.contains(s.run_b)) continue;
      if (!seen.emplace(s.run_a, s.run_b).second) continue;
      if (!artefact) artefact = s.artefact;
      if (!request.mixed && (s.artefact.angle_error_rad != artefact->angle_error_rad ||
                             s.artefact.corner != artefact->corner)) {
        others.push_back(s.id);
        continue;
      }
      fits.push_back(s);
    }
    if (static_cast<std::int64_t>(page.size()) < kRunsPage) break;
  }
  if (!others.empty())
    trend.left_out.push_back(std::to_string(others.size()) +
                             (others.size() == 1 ? " squareness fit" : " squareness fits") +
                             ": the angle or the measured corner of the artefact differs from the "
                             "newest squareness fit (" +
                             words::remedy(Remedy::mix_runs) + ")");
  const auto started = [&](const Squareness& s) {
    return std::max(allowed[s.run_a]->started_utc, allowed[s.run_b]->started_utc);
  };
  std::sort(fits.begin(), fits.end(), [&](const Squareness& s, const Squareness& t) {
    return std::tuple(started(s), s.run_a, s.run_b) < std::tuple(started(t), t.run_a, t.run_b);
  });
  for (const Squareness& s : fits) {
    MDOF_TRY(const FittedSquareness fitted, stored_squareness(store, s));
    add_value(trend, {s.run_a, s.run_b}, started(s), fitted.budgets.front(), true);
  }
  if (!trend.values.empty() || !request.figure.empty()) out.push_back(std::move(trend));
  return {};
}

Status check_figure(const TrendRequest& request) {
  std::string names;
  for (const AxisPair axes : kAxisPairs) {
    if (request.axis) break;
    if (figure_of(axes) == request.figure) return {};
    names += (names.empty() ? "" : ", ") + figure_of(axes);
  }
  for (const Axis axis : kAxes) {
    if (request.axis && *request.axis != axis) continue;
    for (const algo::Figure& figure : algo::figures_of_run(axis)) {
      if (figure.name == request.figure) return {};
      names += (names.empty() ? "" : ", ") + figure.name;
    }
  }
  if (request.figure.empty()) return {};
  return fail(ErrorCode::usage,
              "figure \"" + request.figure + "\" is unknown; give one of: " + names);
}

}  // namespace

Result<std::vector<Trend>> trends(store::Store& store, const TrendRequest& request) {
  MDOF_CHECK(check_figure(request));
  for (const std::int64_t run : request.without) MDOF_CHECK(store.run_header(run));
  std::vector<Trend> out;
  for (const AxisPair axes : kAxisPairs)
    if (!request.axis && (request.figure.empty() || request.figure == figure_of(axes)))
      MDOF_CHECK(add_squareness(store, axes, request, out));
  for (const Axis axis : kAxes)
    if (!request.axis || *request.axis == axis) MDOF_CHECK(add_axis(store, axis, request, out));
  for (Trend& trend : out) {
    std::vector<algo::ChartValue> values;
    for (const TrendValue& v : trend.values) values.push_back({v.stated.value, v.stated.u_random});
    trend.baseline = request.baseline;
    trend.chart = algo::control_chart(values, request.baseline);
  }
  return out;
}

}  // namespace mdof::daemon
