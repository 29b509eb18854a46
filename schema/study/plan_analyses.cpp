// Reads outputs, precision, indices, tolerances, the compared fixture and the settings of a plan.
#include <algorithm>
#include <set>

#include "schema/axis.h"
#include "schema/base/number/number_text.h"
#include "schema/study/plan_parts.h"

namespace mdof::plan_parts {
namespace {

std::vector<PlannedOutput> possible_outputs(const StudyPlan& plan) {
  std::vector<PlannedOutput> all;
  for (std::size_t i = 0; i < kErrorCount; ++i) {
    const ErrorName& error = error_names(plan.rig.axis)[i];
    const std::string name = error.name, unit = error.angle ? "_urad" : "_um";
    if (plan.whole_run) all.push_back({name + "_worst" + unit, OutputKind::worst, i});
    if (!plan.whole_run) all.push_back({error.key, OutputKind::error, i});
    if (error.angle) continue;
    all.push_back({name + "_straightness_um", OutputKind::straightness, i});
    all.push_back({name + "_straightness_end_point_um", OutputKind::straightness_ends, i});
  }
  if (plan.rig_y && !plan.whole_run) all.push_back({"EC0Y_urad", OutputKind::squareness, 0});
  return all;
}

bool has_output(const StudyPlan& plan, const std::string& key) {
  return std::any_of(plan.outputs.begin(), plan.outputs.end(),
                     [&](const PlannedOutput& o) { return o.key == key; });
}

std::vector<std::string> output_keys(const StudyPlan& plan) {
  std::vector<std::string> keys;
  for (const auto& output : plan.outputs) keys.push_back(output.key);
  return keys;
}

void read_adaptive(TomlTable& table, StudyPlan& plan) {
  auto adaptive = table.table("adaptive");
  if (!adaptive) return;
  plan.adaptive.emplace();
  plan.adaptive->digits = static_cast<int>(read_count(*adaptive, "digits", 2, 1, 6));
  auto tolerances = adaptive->table("tolerance");
  if (!tolerances) return;
  for (const auto& output : plan.outputs) {
    const double tolerance = read_above_zero(*tolerances, output.key, 1);
    if (tolerances->has(output.key)) plan.adaptive->tolerances[output.key] = tolerance;
  }
}

PlannedAllocation read_allocation(TomlTable& table, const StudyPlan& plan) {
  PlannedAllocation a;
  a.where = table.where("output");
  a.output = table.string("output");
  if (!has_output(plan, a.output))
    table.reject("output", "\"" + a.output + "\" is not an output of this plan; " +
                               known_words_hint(a.output, output_keys(plan)));
  a.limit = table.number("limit");
  if (!(a.limit > 0))
    table.reject("limit", "must be greater than zero, not " + plain_number(a.limit));
  a.probability = read_share(table, "probability", a.probability);
  a.trials = read_count(table, "trials", a.trials, 100, 10'000'000);
  a.tolerances = table.strings("tolerances");
  std::vector<std::string> names;
  for (const auto& quantity : plan.quantities) names.push_back(quantity.name);
  for (const auto& name : a.tolerances) {
    if (!has_quantity(plan, name))
      table.reject("tolerances", "\"" + name + "\" is not a quantity of this plan; " +
                                     known_words_hint(name, names));
  }
  for (const auto& name : a.tolerances) {
    if (std::count(a.tolerances.begin(), a.tolerances.end(), name) > 1)
      table.reject("tolerances", "\"" + name + "\" is listed twice");
  }
  if (a.tolerances.empty()) table.reject("tolerances", "must list at least one quantity");
  return a;
}

void read_series(TomlTable& table, StudyPlan& plan) {
  if (auto series = table.table("series")) {
    plan.series_positions =
        static_cast<std::size_t>(read_count(*series, "positions", plan.series_positions, 3, 1000));
    const double period_mm = read_above_zero(*series, "period_mm", 1);
    if (series->has("period_mm")) plan.series_period_mm = period_mm;
  }
  if (auto expansion = table.table("expansion")) {
    plan.fixture_per_K = expansion->number("fixture_ppm_per_K", 0.0) / 1e6;
    plan.target_per_K = expansion->number("target_ppm_per_K", 0.0) / 1e6;
  }
  if (auto flatness = table.table("flatness"))
    plan.flatness_length_mm = read_above_zero(*flatness, "length_mm", plan.flatness_length_mm);
}

void read_run(TomlTable& table, StudyPlan& plan) {
  auto run = table.table("run");
  plan.run.targets_mm = {0, 10, 20, 30, 40, 50, 60};
  if (!run) return;
  plan.run.targets_mm = run->numbers("targets_mm", plan.run.targets_mm);
  const auto& t = plan.run.targets_mm;
  const bool ascending = std::adjacent_find(t.begin(), t.end(),
                                            [](double a, double b) { return !(a < b); }) == t.end();
  if (t.size() < 3 || t.size() > 100 || !ascending)
    run->reject("targets_mm", "must be 3 to 100 positions in increasing order");
  plan.run.dwell_s = read_above_zero(*run, "dwell_s", plan.run.dwell_s);
  plan.run.rate_hz = read_above_zero(*run, "rate_hz", plan.run.rate_hz);
  plan.run.speed_mm_s = read_above_zero(*run, "speed_mm_s", plan.run.speed_mm_s);
  if (plan.run.dwell_s > 60) run->reject("dwell_s", "must be at most 60");
  if (plan.run.rate_hz > 10'000) run->reject("rate_hz", "must be at most 10000");
}

}  // namespace

void read_outputs(TomlTable& table, StudyPlan& plan) {
  const auto all = possible_outputs(plan);
  std::vector<std::string> names;
  for (const auto& output : all) names.push_back(output.key);
  const bool given = table.has("outputs");
  std::set<std::string> seen;
  for (const std::string& key : table.strings("outputs")) {
    const auto found = std::find(names.begin(), names.end(), key);
    if (found == names.end()) {
      const bool square = key == "EC0Y_urad";
      table.reject(
          "outputs",
          "\"" + key + "\" is not an output of this plan; " +
              (square
                   ? "this output needs the key \"rig_y\" in [squareness] and output_of = \"point\""
                   : known_words_hint(key, names)));
      return;
    }
    if (!seen.insert(key).second) table.reject("outputs", "\"" + key + "\" is listed twice");
    plan.outputs.push_back(all[static_cast<std::size_t>(found - names.begin())]);
  }
  if (given && plan.outputs.empty()) table.reject("outputs", "must list at least one output");
  if (given) return;
  const OutputKind usual = plan.whole_run ? OutputKind::worst : OutputKind::error;
  for (const auto& output : all)
    if (output.kind == usual) plan.outputs.push_back(output);
}

void read_analyses(TomlTable& table, const std::filesystem::path& folder, StudyPlan& plan) {
  read_adaptive(table, plan);
  if (auto indices = table.table("indices")) {
    plan.indices.emplace();
    plan.indices->trials = read_count(*indices, "trials", 65536, 2, 1'000'000'000);
    plan.indices->each_probe = indices->boolean("each_probe", false);
  }
  for (auto& allocation : table.tables("allocation"))
    plan.allocations.push_back(read_allocation(allocation, plan));
  if (auto compare = table.table("compare")) plan.compare = read_rig(*compare, "rig", folder);
  if (plan.compare && plan.compare->axis != plan.rig.axis)
    table.reject("compare", "must name a rig that measures the same axis as the rig of this plan");
}

void read_settings(TomlTable& table, StudyPlan& plan) {
  read_series(table, plan);
  read_run(table, plan);
}

}  // namespace mdof::plan_parts
