#include "tools/mdof/stored/run_positioning.h"

#include <algorithm>

#include "algo/iso230/positioning/positioning.h"
#include "algo/iso230/positioning/run_readings.h"
#include "algo/sequence/usable_runs.h"
#include "algo/uncertainty/positioning/positioning_budgets.h"
#include "daemon/measure/evaluation.h"
#include "daemon/words/error_text.h"
#include "daemon/words/words.h"
#include "schema/base/append_new.h"
#include "schema/iso230/iso230_json.h"
#include "schema/run_json.h"
#include "tools/mdof/text/run_tables.h"
#include "tools/mdof/text/text_table.h"

namespace mdof::tools {
namespace {

// The index of the error in error_names().
Result<std::size_t> place_of_error(const std::string& asked, Axis axis) {
  std::string known;
  for (std::size_t k = 0; k < 5; ++k) {
    if (asked == error_names(axis)[k].name) return k;
    known += std::string(" ") + error_names(axis)[k].name;
  }
  return fail(ErrorCode::usage, "--error " + asked + ": the errors of a run of axis " +
                                    letter(axis) + " are" + known);
}

Result<std::vector<std::size_t>> chosen_errors(const std::vector<std::string>& asked, Axis axis) {
  if (asked.empty()) return std::vector<std::size_t>{0, 1, 2, 3, 4};
  std::vector<std::size_t> chosen;
  for (const auto& name : asked) {
    MDOF_TRY(const std::size_t k, place_of_error(name, axis));
    append_new(chosen, {k});
  }
  return chosen;
}

Status add_error(const Run& run, std::size_t k, double scale_period_m, RunPositioning& found) {
  const auto series = algo::readings_of_run(run, k, found.keep_slope);
  auto figures = algo::positioning(series.readings);
  if (!figures) {
    figures.error().remedy = Remedy::replay_with_targets;
    return in_context("run " + std::to_string(run.header.id), std::move(figures.error()));
  }
  append_new(found.notices, algo::plan_notices(*figures, scale_period_m));
  if (series.left_out > 0)
    append_new(found.notices,
               {notice(NoticeCode::readings_left_out, "",
                       {{"left_out", series.left_out}, {"points", run.points.size()}})});
  const ErrorName& name = error_names(run.header.axis)[k];
  constexpr std::size_t kMinLineTargets = 3;  // a line through two targets has no residuals
  if (!name.angle && !found.keep_slope && figures->targets.size() < kMinLineTargets)
    return bad_input("run " + std::to_string(run.header.id) + ": the straightness " + name.name +
                     " needs at least three targets with error values; give --keep-slope to keep "
                     "the slope, or --error with an angular error");
  found.columns.push_back({name.name, name.angle, std::move(*figures)});
  return {};
}

// Adds U to every column. If U of one column is unknown, no column gets U.
Status add_uncertainty(const Run& run, const std::vector<std::size_t>& chosen,
                       RunPositioning& found) {
  MDOF_TRY(const Rig rig, daemon::rig_of(run.header));
  std::vector<RunPositioningUncertainty> all;
  for (const std::size_t k : chosen) {
    MDOF_TRY(auto U, algo::run_positioning_uncertainty(rig, run, k, found.keep_slope));
    all.push_back(std::move(U));
  }
  for (std::size_t i = 0; i < all.size(); ++i) found.columns[i].U = std::move(all[i]);
  return {};
}

const char* const kNotInR =
    "R (ISO 230-2) is calculated from the repeated approaches to each target in this run, and is "
    "valid for these approaches only. U does not contain the uncertainty that results from the "
    "small number of approaches. U of A is unknown (null), because ";

}  // namespace

Result<RunPositioning> run_positioning(const Run& run, const RunPositioningRequest& request,
                                       double scale_period_m) {
  MDOF_CHECK(algo::check_usable({&run}, request.partial, "ISO 230-2 figures"));
  MDOF_TRY(const auto chosen, chosen_errors(request.errors, run.header.axis));
  RunPositioning found;
  found.keep_slope = request.keep_slope;
  found.notices = algo::inherited_notices({&run});
  for (const std::size_t k : chosen) MDOF_CHECK(add_error(run, k, scale_period_m, found));
  if (const Status known = add_uncertainty(run, chosen, found); !known)
    found.U_reason = words::text(known.error());
  return found;
}

std::string run_positioning_json(const Run& run, const RunPositioning& found) {
  JsonWriter json;
  json.begin_object()
      .field("run", run.header.id)
      .field("axis", std::string(1, letter(run.header.axis)))
      .field("model", run.header.provenance.model);
  write_reference(json, run.header.stated);
  json.field("straightness_reference", found.keep_slope ? "as measured" : "least squares line")
      .field("simulated", run.header.simulated)
      .key("cycle");
  run.plausibility ? json.value(run.plausibility->cycle) : json.null();
  json.key("errors").begin_object();
  for (const auto& column : found.columns) {
    json.key(column.name + (column.angle ? "_urad" : "_um")).begin_object();
    write_positioning(json, column.figures, column.angle);
    json.key("uncertainty");
    column.U ? write_run_positioning_uncertainty(json, *column.U, column.angle)
             : static_cast<void>(json.null());
    json.end_object();
  }
  json.end_object();
  if (!found.U_reason.empty()) json.field("uncertainty_reason", found.U_reason);
  json.end_object();
  return with_notices(json.take(), found.notices, words::text);
}

namespace {

// The text before the figures that states which sources U contains, for the column whose U contains
// most sources.
std::string U_text(const RunPositioning& found, bool simulated, std::size_t width) {
  if (!found.U_reason.empty())
    return simulated_notice(simulated) + wrapped("U is unknown: " + found.U_reason, width) + "\n";
  const auto covers_more = [](const PositioningColumn& column) { return !column.U->noise_only; };
  const auto most = std::find_if(found.columns.begin(), found.columns.end(), covers_more);
  const bool noise_only = most == found.columns.end();
  const auto& U = (noise_only ? found.columns.begin() : most)->U;
  std::string text = "U is the expanded uncertainty (95 %). It contains " + U->covers;
  if (!U->not_declared.empty()) text += "; not declared: " + joined(U->not_declared);
  return noise_only_notice(noise_only) + simulated_notice(simulated) +
         wrapped(text + ". " + kNotInR + U->kWhyNotOfA, width) + "\n\n";
}

}  // namespace

std::string run_positioning_text(const Run& run, const RunPositioning& found, std::size_t width) {
  std::string text =
      U_text(found, run.header.simulated, width) + parameters_text(found.columns, width);
  if (found.columns.size() == 1) text += "\n" + targets_text(found.columns[0], width);
  const std::string cycle = run.plausibility ? "; cycle: " + run.plausibility->cycle : "";
  return text + stated_text(run.header.stated) +
         wrapped(std::string("straightness: ") +
                     (found.keep_slope
                          ? "as measured, including the slope"
                          : "about the least-squares line of the mean of both approaches") +
                     cycle,
                 width) +
         "\n";
}

}  // namespace mdof::tools
