#include "tools/mdof/text/analyses/drift_text.h"

#include <cmath>

#include "algo/drift/drift_sentences.h"
#include "algo/model/restate.h"
#include "schema/units.h"
#include "tools/mdof/text/run_tables.h"
#include "tools/mdof/text/text_table.h"

namespace mdof::tools {
namespace {

constexpr double kSecondsPerMinute = 60;

std::string shape_of(const algo::SeriesDrift& drift) {
  if (drift.steps) return "drift or steps";
  if (drift.order == 0) return "none significant";
  return drift.order == 1 ? "steady" : "curved, order " + std::to_string(drift.order);
}

std::string closures_text(const Run& run, const std::vector<algo::Closure>& closures,
                          std::size_t width) {
  std::vector<std::string> head{"run", "after/min", "from"};
  const auto& names = error_names(run.header.axis);
  for (const auto& name : names) head.push_back(error_label(name.key));
  TextTable table(std::move(head));
  for (const algo::Closure& c : closures) {
    const Errors5 change = named_from_local(run.header.moving(), c.change);
    std::vector<std::string> row{
        std::to_string(c.run), fixed(c.after_s / kSecondsPerMinute, 2),
        c.same_side ? "same side" : "opposite side (includes reversal error)"};
    for (std::size_t k = 0; k < kErrorCount; ++k)
      row.push_back(names[k].angle ? in_urad(change[k]) : in_um(change[k]));
    table.add(std::move(row));
  }
  return wrapped(
             "closure: change of the errors from the first point of a run to a later point at the "
             "same target. The errors refer to the fixture",
             width) +
         "\n" + table.text(width);
}

std::string changes_table(const Run& run, const algo::RunDrift& drift, std::size_t width) {
  TextTable table({"error", "drift", "first to last point", "highest - lowest", "detectable from"});
  const Errors5 signs = named_from_local(run.header.moving(), Errors5{1, 1, 1, 1, 1});
  const auto& names = error_names(run.header.axis);
  for (std::size_t k = 0; k < kErrorCount; ++k) {
    const algo::SeriesDrift& of = drift.errors[names[k].local];
    const auto show = names[k].angle ? in_urad : in_um;
    const auto with_u = names[k].angle ? urad_with_u : um_with_u;
    table.add({error_label(names[k].key), shape_of(of),
               of.significant() ? with_u(signs[k] * of.change, of.u_change, 0) : "-",
               of.significant() ? show(of.range) : "-", show(of.least_found)});
  }
  return "drift over " + fixed(drift.length_s / kSecondsPerMinute, 2) + " min\n" +
         table.text(width);
}

std::string without_text(const Run& run, const std::vector<StraightnessFigure>& without,
                         std::size_t width) {
  const Run at_fixture = algo::restate(run, kAtFixture);
  TextTable table({"error", "approach", "least squares/µm", "without drift/µm", "slope/µrad",
                   "without drift/µrad"},
                  2);
  for (std::size_t i = 0; i < without.size() && i < at_fixture.straightness.size(); ++i) {
    const StraightnessFigure &with = at_fixture.straightness[i], &none = without[i];
    table.add({with.error_key.substr(0, 3), with.approach, in_um(with.straightness_least_squares_m),
               in_um(none.straightness_least_squares_m), in_urad(with.slope_least_squares_rad),
               in_urad(none.slope_least_squares_rad)});
  }
  return "straightness with and without drift, at the fixture\n" + table.text(width);
}

}  // namespace

std::string drift_notice(const Run& run, const algo::RunDrift& drift, std::size_t width) {
  const std::string changes = algo::changes_text(drift, run.header.moving(), false);
  const std::string steps = algo::changes_text(drift, run.header.moving(), true);
  std::string text;
  if (!changes.empty())
    text += wrapped("drift: " + changes +
                        ". All errors of a single approach, and all errors relative to the first "
                        "point, contain this drift. Let the system warm up (\"mdof drift\" shows "
                        "when the system is ready), or replay the log with --remove-drift",
                    width) +
            "\n";
  if (!steps.empty())
    text +=
        wrapped(
            "changes from run to run: " + steps +
                ". These changes may be steps or a drift, so --remove-drift does not remove them",
            width) +
        "\n";
  return text;
}

std::string drift_text(const Run& run, const StoredDrift& drift, std::size_t width) {
  std::string text;
  if (!drift.found.closures.empty()) text = closures_text(run, drift.found.closures, width) + "\n";
  if (!drift.found.not_seen.empty())
    return text + wrapped("the drift cannot be estimated: " + drift.found.not_seen, width) + "\n";
  text += changes_table(run, drift.found, width);
  if (!drift.without.empty()) text += "\n" + without_text(run, drift.without, width);
  const std::string notice = drift_notice(run, drift.found, width);
  return notice.empty() ? text : text + "\n" + notice;
}

}  // namespace mdof::tools
