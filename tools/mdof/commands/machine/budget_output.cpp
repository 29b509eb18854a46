#include "tools/mdof/commands/machine/budget_output.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "schema/base/number/number_text.h"
#include "schema/units.h"
#include "tools/mdof/commands/machine/machine_file.h"
#include "tools/mdof/terminal.h"
#include "tools/mdof/text/run_tables.h"
#include "tools/mdof/text/text_table.h"

namespace mdof::tools {
namespace {

constexpr const char* kNothingDeclared =
    "no uncertainty is declared: MACHINE.toml has no [[source]] that acts on the tool, and no u of "
    "a measured error";
constexpr const char* kDirections[] = {"x", "y", "z"};
constexpr const char* kNotKept =
    "the measured errors alone exceed the target, so the target is not met even with u = 0 for "
    "every declared source";
constexpr const char* kFactorRule = "all u are multiplied by the same factor";

// The indices of the rows, sorted by their part of u_x² + u_y² + u_z², the largest first.
std::vector<std::size_t> rows_by_variance(const algo::BudgetModel& model) {
  std::vector<std::size_t> order(model.rows.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::stable_sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) {
    return model.rows[a].variance_m2 > model.rows[b].variance_m2;
  });
  return order;
}

double share(const algo::BudgetModel& model, double variance_m2) {
  return variance_m2 / algo::budget_u_m(model).squaredNorm();  // 0/0: NaN
}

void write_place(JsonWriter& json, const char* key, const Eigen::Vector3d& place_m) {
  json.key(key).begin_object();
  for (int k = 0; k < 3; ++k) json.field(kDirections[k], to_um(place_m[k]));
  json.end_object();
}

// Writes u and intervals of x, y and z, and the median and 95 % quantile of the error vector's
// length ("volume"). If a stage has no causes, writes null with the reason.
void write_stage(JsonWriter& json, const FoundStage& stage) {
  if (stage.outputs.empty()) {
    for (const char* key : {"u_um", "interval_um", "volume_p95_um"}) json.key(key).null();
    json.field("reason", kNothingDeclared);
    return;
  }
  write_place(json, "u_um", algo::budget_u_m(stage.model));
  json.key("u_monte_carlo_um").begin_object();
  for (std::size_t k = 0; k < 3; ++k) json.field(kDirections[k], stage.outputs[k].sd);
  json.end_object().key("interval_um").begin_object();
  for (std::size_t k = 0; k < 3; ++k) {
    const CoverageInterval& interval = stage.outputs[k].symmetric;
    json.key(kDirections[k]).begin_array().value(interval.low).value(interval.high).end_array();
  }
  json.end_object()
      .field("volume_median_um", stage.outputs[3].quantiles[0].value)
      .field("volume_p95_um", stage.volume_p95_um);
}

void write_contributions(JsonWriter& json, const algo::BudgetModel& model) {
  json.key("contributions").begin_array();
  for (const std::size_t i : rows_by_variance(model)) {
    const algo::BudgetRow& row = model.rows[i];
    json.begin_object()
        .field("name", row.name)
        .field("u", row.u)
        .field("unit", row.unit)
        .field("distribution", to_string(row.shape));
    write_place(json, "sensitivity", row.sensitivity);
    write_place(json, "contribution_um", row.contribution_m());
    json.field("share", share(model, row.variance_m2)).end_object();
  }
  json.end_array();
}

// The quantities that the errors of several axes have in common, the largest contribution first.
// The rows of these errors contain them.
std::vector<const algo::BudgetCause*> shared_causes(const algo::BudgetModel& model) {
  std::vector<const algo::BudgetCause*> shared;
  for (const algo::BudgetCause& cause : model.causes)
    if (cause.is_shared) shared.push_back(&cause);
  std::stable_sort(shared.begin(), shared.end(),
                   [](const algo::BudgetCause* a, const algo::BudgetCause* b) {
                     return a->contribution_m().squaredNorm() > b->contribution_m().squaredNorm();
                   });
  return shared;
}

void write_shared(JsonWriter& json, const algo::BudgetModel& model) {
  json.key("shared_by_axes").begin_array();
  for (const algo::BudgetCause* cause : shared_causes(model)) {
    json.begin_object().field("name", cause->name);
    write_place(json, "contribution_um", cause->contribution_m());
    json.field("share", share(model, cause->contribution_m().squaredNorm())).end_object();
  }
  json.end_array();
}

void write_allocation(JsonWriter& json, const algo::BudgetModel& model,
                      const FoundAllocation& found) {
  json.field("allocation_rule", kFactorRule).field("allocation_factor", found.common_factor);
  if (found.common_factor == 0) json.field("allocation_reason", kNotKept);
  json.key("allocation").begin_array();
  for (const std::size_t i : rows_by_variance(model)) {
    const algo::BudgetRow& row = model.rows[i];
    json.begin_object()
        .field("name", row.name)
        .field("u", row.u)
        .field("unit", row.unit)
        .field("allowed_u", row.u * found.common_factor)
        .field("allowed_u_alone", row.u * found.alone[i])
        .end_object();
  }
  json.end_array();
}

void write_measured(JsonWriter& json, const FoundMachineBudget& found) {
  write_strings(json, "replaced_by_measurement", found.now.model.replaced);
  json.key("measured").begin_array();
  for (const algo::MeasuredError& e : found.measured) {
    const char* unit = e.k < 3 ? "um" : "urad";
    json.begin_object().field("name", e.name).field("unit", unit).key("designed_u");
    e.has_design ? json.value(e.designed_u * 1e6) : json.null();
    json.field("measured_rms", e.measured_u * 1e6).key("designed_effect_um");
    e.has_design ? json.value(to_um(e.designed_effect_m)) : json.null();
    json.field("measured_effect_um", to_um(e.measured_effect_m)).end_object();
  }
  json.end_array();
  if (!found.designed) return;
  json.key("designed").begin_object();
  write_stage(json, *found.designed);
  json.end_object();
}

std::string at_text(const Machine& machine, const algo::Command& at) {
  std::string text;
  for (const MachineFrame& frame : machine.frames)
    if (frame.kind != FrameKind::fixed)
      text += " " + frame.id + " " +
              plain_number(written_position(frame, algo::command_of(frame, at)), 6) + " " +
              position_unit(frame);
  return text;
}

std::string stage_text(const FoundStage& stage) {
  if (stage.outputs.empty()) return wrapped(kNothingDeclared, terminal_columns()) + "\n";
  const Eigen::Vector3d u = algo::budget_u_m(stage.model);
  TextTable table({"", "u/µm, linear", "u/µm, Monte Carlo", "95 % from/µm", "to/µm"});
  for (std::size_t k = 0; k < 3; ++k) {
    const OutputSummary& output = stage.outputs[k];
    table.add({kDirections[k], fixed(to_um(u[static_cast<Eigen::Index>(k)]), 4),
               fixed(output.sd, 4), fixed(output.symmetric.low, 4),
               fixed(output.symmetric.high, 4)});
  }
  return table.text(terminal_columns()) + "95 % of the error vectors are shorter than " +
         fixed(stage.volume_p95_um, 4) + " µm\n";
}

std::vector<std::string> contribution_cells(const Eigen::Vector3d& contribution_m, double share) {
  std::vector<std::string> cells;
  for (int k = 0; k < 3; ++k) cells.push_back(fixed(to_um(contribution_m[k]), 4));
  cells.push_back(fixed(100 * share, 1));
  return cells;
}

std::string shared_text(const algo::BudgetModel& model) {
  TextTable table({"shared by the axes", "x/µm", "y/µm", "z/µm", "share/%"});
  const auto shared = shared_causes(model);
  if (shared.empty()) return "";
  for (const algo::BudgetCause* cause : shared) {
    std::vector<std::string> row = {cause->name};
    const Eigen::Vector3d part = cause->contribution_m();
    for (std::string& cell : contribution_cells(part, share(model, part.squaredNorm())))
      row.push_back(std::move(cell));
    table.add(row);
  }
  return "\n" + table.text(terminal_columns()) +
         wrapped("The errors above contain these quantities, which act on several axes.",
                 terminal_columns()) +
         "\n";
}

std::string allowed_u(double u, double factor) {
  if (factor == 0) return "none";
  return std::isfinite(factor) ? plain_number(u * factor, 4) : "any";
}

std::string contributions_text(const FoundMachineBudget& found) {
  const algo::BudgetModel& model = found.now.model;
  std::vector<std::string> head = {"cause", "u", "unit", "x/µm", "y/µm", "z/µm", "share/%"};
  if (found.allocation)
    for (const char* name : {"allowed u", "alone"}) head.push_back(name);
  TextTable table(head);
  for (const std::size_t i : rows_by_variance(model)) {
    const algo::BudgetRow& cause = model.rows[i];
    std::vector<std::string> row = {cause.name, plain_number(cause.u, 4), cause.unit};
    for (std::string& cell :
         contribution_cells(cause.contribution_m(), share(model, cause.variance_m2)))
      row.push_back(std::move(cell));
    if (found.allocation)
      for (const double factor : {found.allocation->common_factor, found.allocation->alone[i]})
        row.push_back(allowed_u(cause.u, factor));
    table.add(row);
  }
  std::string text = "\n" + table.text(terminal_columns());
  if (has_correlated_rows(model))
    text += wrapped(
                "Some errors are correlated, because the same probes measured them. Therefore the "
                "squares of their contributions do not add up to u²; the share contains the "
                "covariances and can be negative.",
                terminal_columns()) +
            "\n";
  return text + shared_text(model);
}

std::string allocation_text(const FoundAllocation& allocation, double target_um) {
  std::string text;
  if (allocation.common_factor == 0)
    text = std::string(kNotKept) + ".";
  else
    text =
        "\"allowed u\": with these u of all sources, 95 % of the error vectors are shorter than " +
        plain_number(target_um, 6) + " µm (" + kFactorRule + ", " +
        fixed(allocation.common_factor, 4) + ").";
  text +=
      " \"alone\": largest permitted u of this source if all other sources keep their declared u "
      "(\"any\": no limit; \"none\": the target is not met even with u = 0)";
  return wrapped(text, terminal_columns()) + "\n";
}

// `at`: the positions of the axes.
std::string measured_text(const FoundMachineBudget& found, const std::string& at) {
  if (found.measured.empty()) return "";
  TextTable table({"measured error", "designed/µm", "measured/µm", "ratio"});
  for (const algo::MeasuredError& e : found.measured)
    table.add({e.name, e.has_design ? fixed(to_um(e.designed_effect_m), 4) : "-",
               fixed(to_um(e.measured_effect_m), 4),
               e.has_design ? fixed(e.measured_effect_m / e.designed_effect_m, 2) : "-"});
  std::string text = "\n" + table.text(terminal_columns()) +
                     wrapped(
                         "Each value is the effect of a measured error on the position of the tool "
                         "(RMS over all positions of the error table). The axes are at" +
                             at +
                             ". The effect of an angle or a squareness depends on this position "
                             "(--at), and so does the order of the rows. To improve the machine at "
                             "this position, first reduce the error in the first row.",
                         terminal_columns()) +
                     "\n";
  if (!found.now.model.replaced.empty())
    text += wrapped("sources replaced by measured errors: " + joined(found.now.model.replaced),
                    terminal_columns()) +
            "\n";
  if (found.designed)
    text +=
        "\n"
        "as designed, without the measured errors:\n" +
        stage_text(*found.designed);
  return text;
}

}  // namespace

std::string machine_budget_json(const Machine& machine, const BudgetRequest& request,
                                const FoundMachineBudget& found) {
  const algo::BudgetModel& model = found.now.model;
  JsonWriter json;
  json.begin_object()
      .field("machine", machine.name)
      .field("chain", machine.chain.text)
      .field("simulated", machine.simulated)
      .field("noise_only", noise_only(machine, true) == NoiseOnly::all);
  write_command(json, "at", machine, request.at);
  write_place(json, "error_um", algo::exact_error(machine, request.at, model.values).head<3>());
  json.field("trials", request.trials)
      .field("seed", request.seed)
      .field("coverage", kBudgetCoverage)
      .key("by")
      .begin_object()
      .field("u_um", "law of propagation of uncertainty (GUM), with exact derivatives")
      .field("interval_um", "exact product of rotations, Monte Carlo")
      .field("volume_p95_um", "exact product of rotations, Monte Carlo")
      .end_object();
  write_stage(json, found.now);
  write_contributions(json, model);
  write_shared(json, model);
  write_strings(json, "not_declared", model.not_declared);
  if (request.target_um) json.field("target_um", *request.target_um);
  if (found.allocation) write_allocation(json, model, *found.allocation);
  if (request.target_um && !found.allocation) json.key("allocation").null();
  write_measured(json, found);
  write_stored_notices(json, machine);
  json.end_object();
  return json.take();
}

std::string machine_budget_text(const Machine& machine, const BudgetRequest& request,
                                const FoundMachineBudget& found) {
  std::string text = noise_only_notice(noise_only(machine, true)) +
                     simulated_notice(machine.simulated) + machine.name + ", " +
                     machine.chain.text + ", at" + at_text(machine, request.at) + "\n" +
                     approach_text(machine, request.approach) + stage_text(found.now);
  if (!found.now.outputs.empty()) text += contributions_text(found);
  if (found.allocation) text += allocation_text(*found.allocation, *request.target_um);
  if (const auto& names = found.now.model.not_declared; !names.empty())
    text += wrapped("no [[source]] and no u is declared for " + std::to_string(names.size()) +
                        " errors that act on the tool" +
                        (names.size() <= 12 ? ": " + joined(names) : ""),
                    terminal_columns()) +
            "\n";
  return text + measured_text(found, at_text(machine, request.at));
}

}  // namespace mdof::tools
