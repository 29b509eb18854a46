// mdof milling --preset micro-end-mill | PLAN.toml: calculates forces, deflection and wall of a
// micro end mill.
#include <CLI/CLI.hpp>
#include <cmath>
#include <optional>

#include "algo/milling/beam.h"
#include "algo/milling/milling.h"
#include "daemon/output/charts/form/wall_chart.h"
#include "daemon/output/charts/plot_files.h"
#include "schema/base/files.h"
#include "schema/base/json_writer.h"
#include "schema/milling/milling_plan.h"
#include "schema/run_json.h"
#include "schema/units.h"
#include "tools/mdof/commands/command.h"
#include "tools/mdof/commands/milling/milling_sensitivity.h"
#include "tools/mdof/options.h"
#include "tools/mdof/output.h"
#include "tools/mdof/study/running/workers.h"
#include "tools/mdof/terminal.h"
#include "tools/mdof/text/text_table.h"

namespace mdof::tools {
namespace {

constexpr const char* kPreset = "micro-end-mill";

struct MillingCommand {
  std::string plan, preset, plots;
  bool offset = false, sensitivity = false, json = false;
  double trials = 64, seed = 1;
  unsigned threads = default_threads();
};

// A plan with one deflection model, and the results.
struct MilledModel {
  MillingPlan plan;
  algo::MillingResult result;
  std::optional<algo::WearOffset> offset;
  std::optional<MillingSensitivity> sensitivity;
};

MillingSensitivityRequest request_of(const MillingCommand& o) {
  return {static_cast<std::uint64_t>(o.trials), static_cast<std::uint64_t>(o.seed), o.threads};
}

Result<MilledModel> mill(const DeclaredMillingPlan& declared, const MillingCommand& o) {
  MilledModel milled{declared.plan, {}, {}, {}};
  MDOF_TRY(milled.result, algo::milling(declared.plan));
  if (o.offset) {
    MDOF_TRY(milled.offset, algo::wear_offset(declared));
  }
  if (o.sensitivity) {
    MDOF_TRY(milled.sensitivity, find_milling_sensitivity(declared, request_of(o)));
  }
  return milled;
}

std::vector<std::string> names_of(const std::vector<const MillingInput*>& inputs) {
  std::vector<std::string> names;
  for (const MillingInput* input : inputs) names.push_back(input->name());
  return names;
}

double deg(double rad) {
  return rad / algo::kHalfTurn_rad * 180;
}

std::string line_to_type(const algo::WearOffset& offset) {
  return "G10 L13 P1 R" + fixed(to_mm(offset.offset_m), 5);
}

void write_offset(JsonWriter& json, const algo::WearOffset& offset) {
  json.field("wear_offset_um", to_um(offset.offset_m)).field("u_wear_offset_um", to_um(offset.u_m));
  if (offset.parts.empty())
    json.field("u_reason", "the plan declares no uncertainty (no key such as u_Kt_N_per_mm2)");
  json.key("contributions").begin_array();
  for (const auto& part : offset.parts)
    json.begin_object()
        .field("name", part.input->name())
        .field("contribution_um", to_um(part.contribution_m))
        .end_object();
  json.end_array();
  write_strings(json, "not_declared", names_of(offset.not_declared));
  json.field("wear_offset_sense",
             "the offset is added to the radius of the tool, with the same sign for G41 and G42")
      .field("wear_offset_line", line_to_type(offset))
      .field("wear_offset_line_of",
             "Fanuc control, in mm. P is the number of the offset. With G90, R replaces the radius "
             "wear; with G91, the control adds R to the radius wear. Double R if the control uses "
             "diameters");
}

void write_members(JsonWriter& json, const MilledModel& milled, const MillingCommand& o) {
  const MillingPlan& plan = milled.plan;
  const algo::MillingResult& r = milled.result;
  json.key("model")
      .begin_object()
      .field("chip", to_string(plan.chip))
      .field("deflection", to_string(plan.deflection))
      .end_object();
  json.key("force_N")
      .begin_object()
      .field("x_max", r.x_max_N)
      .field("y_max", r.y_max_N)
      .field("x_max_rigid", r.x_max_rigid_N)
      .field("y_max_rigid", r.y_max_rigid_N)
      .field("x_mean", r.x_mean_N)
      .field("y_mean", r.y_mean_N)
      .end_object();
  json.field("deflection_um", to_um(r.deflection_m))
      .field("deflection_rigid_um", to_um(r.deflection_rigid_m))
      .field("shear_left_out_share", algo::shear_share(plan.beam()));
  json.key("window_deg").begin_array().value(deg(r.entry_rad)).value(deg(r.exit_rad)).end_array();
  json.field("power_W", r.power_W);
  json.key("wall")
      .begin_object()
      .field("form_um", to_um(r.wall.form_m))
      .field("waviness_tip_um", to_um(r.wall.waviness_tip_m))
      .field("waviness_root_um", to_um(r.wall.waviness_root_m))
      .field("offset_tip_um", to_um(r.wall.offset_tip_m))
      .field("offset_root_um", to_um(r.wall.offset_root_m))
      .field("offset_mean_um", to_um(r.wall.offset_mean_m))
      .field("Ra_tip_um", to_um(r.wall.Ra_tip_m))
      .field("Ra_root_um", to_um(r.wall.Ra_root_m))
      .end_object();
  json.field("iterations", r.iterations);
  if (milled.offset) write_offset(json, *milled.offset);
  if (milled.sensitivity) write_milling_sensitivity(json, request_of(o), *milled.sensitivity);
}

// The results of the first model are at the top level of the document. The results of another model
// are in a member with the name of this deflection model.
std::string milling_json(const std::vector<MilledModel>& all, const MillingCommand& o) {
  JsonWriter json;
  json.begin_object().field("name", all.front().plan.name);
  if (!all.front().plan.force_source.empty())
    json.field("force_source", all.front().plan.force_source);
  json.field("simulated", true);
  write_members(json, all.front(), o);
  for (std::size_t i = 1; i < all.size(); ++i) {
    json.key(to_string(all[i].plan.deflection)).begin_object();
    write_members(json, all[i], o);
    json.end_object();
  }
  json.end_object();
  return json.take();
}

std::string offset_text(const MilledModel& milled) {
  if (!milled.offset) return "";
  const algo::WearOffset& offset = *milled.offset;
  std::string text =
      "radius wear offset (" + std::string(to_string(milled.plan.deflection)) + "): " +
      (std::isnan(offset.u_m) ? in_um(offset.offset_m) : um_with_u(offset.offset_m, offset.u_m)) +
      " µm, with the same sign for G41 and G42\n"
      "  line for the control (Fanuc, mm): " +
      line_to_type(offset) +
      "\n"
      "  With G90, R replaces the radius wear; with G91, the control adds R to the radius wear.\n"
      "  Double R if the control uses diameters.\n";
  if (offset.parts.empty())
    text += "  u is unknown: the plan declares no uncertainty (no key such as u_Kt_N_per_mm2)\n";
  for (const auto& part : offset.parts)
    text += "  u from " + part.input->name() + ": " +
            um_to_place(part.contribution_m, part.contribution_m) + " µm\n";
  if (!offset.parts.empty() && !offset.not_declared.empty())
    text += wrapped("  u is too small: the plan declares no u of " +
                        joined(names_of(offset.not_declared)),
                    terminal_columns()) +
            "\n";
  return text;
}

std::string milling_text(const std::vector<MilledModel>& all, const MillingCommand& o) {
  std::vector<std::string> head = {""};
  for (const MilledModel& m : all)
    head.push_back(std::string(to_string(m.plan.chip)) + ", " + to_string(m.plan.deflection));
  TextTable table(head);
  const auto row = [&](const char* name, auto&& value) {
    std::vector<std::string> cells = {name};
    for (const MilledModel& m : all) cells.push_back(value(m.result));
    table.add(cells);
  };
  using R = const algo::MillingResult&;
  row("force x, largest/N", [](R r) { return fixed(r.x_max_N, 4); });
  row("  with a rigid tool/N", [](R r) { return fixed(r.x_max_rigid_N, 4); });
  row("force y, largest/N", [](R r) { return fixed(r.y_max_N, 4); });
  row("  with a rigid tool/N", [](R r) { return fixed(r.y_max_rigid_N, 4); });
  row("deflection of the tip/µm", [](R r) { return fixed(to_um(r.deflection_m), 3); });
  row("entry/°", [](R r) { return fixed(deg(r.entry_rad), 2); });
  row("exit/°", [](R r) { return fixed(deg(r.exit_rad), 2); });
  row("power/W", [](R r) { return fixed(r.power_W, 4); });
  row("wall offset at the tip/µm", [](R r) { return in_um(r.wall.offset_tip_m); });
  row("  at the root/µm", [](R r) { return in_um(r.wall.offset_root_m); });
  row("form error over the depth/µm", [](R r) { return in_um(r.wall.form_m); });
  row("waviness at the tip/µm", [](R r) { return in_um(r.wall.waviness_tip_m); });
  row("  at the root/µm", [](R r) { return in_um(r.wall.waviness_root_m); });
  std::string text = all.front().plan.name;
  text +=
      (text.empty() ? "" : "\n") + table.text(terminal_columns()) +
      wrapped(
          "Force on the tool: x points against the feed, y points towards the wall of an up cut. "
          "Wall offset: + is an overcut. The deflection contains bending only; shear would add " +
              fixed(100 * algo::shear_share(all.front().plan.beam()), 1) + " %",
          terminal_columns()) +
      "\n";
  if (!all.front().plan.force_source.empty())
    text +=
        wrapped("force coefficients: " + all.front().plan.force_source, terminal_columns()) + "\n";
  for (const MilledModel& m : all) text += offset_text(m);
  for (const MilledModel& m : all)
    if (m.sensitivity)
      text += "\nsensitivity (" + std::string(to_string(m.plan.deflection)) + ")" +
              milling_sensitivity_text(request_of(o), *m.sensitivity);
  return text;
}

// Draws a chart for each deflection model.
Status write_walls(const std::vector<MilledModel>& all, const std::string& folder) {
  constexpr auto kLanguage = output::Language::english;
  std::vector<charts::NamedChart> drawn;
  if (folder.empty()) return {};
  for (const MilledModel& m : all) {
    MDOF_TRY(const algo::CutTurn turn, algo::cut_turn(m.plan));
    const std::string model = to_string(m.plan.deflection), &name = m.plan.name;
    const std::string title = (name.empty() ? "" : name + ": ") +
                              output::phrase(output::Phrase::wall_of_cut, kLanguage, {model});
    drawn.push_back({"wall-" + charts::file_name(model) + ".svg",
                     charts::wall_svg(algo::wall_lines(m.plan, turn),
                                      m.plan.feed_per_tooth_m * m.plan.teeth, title, kLanguage)});
  }
  return write_plots(drawn, folder);
}

Status milling(const MillingCommand& o) {
  if (o.plan.empty() == o.preset.empty())
    return fail(ErrorCode::usage, "milling needs either PLAN.toml or --preset micro-end-mill");
  std::string text(micro_end_mill_preset());
  if (!o.plan.empty()) {
    MDOF_TRY(text, read_text_file(o.plan));
  }
  MDOF_TRY(DeclaredMillingPlan declared,
           parse_milling_plan(text, o.plan.empty() ? o.preset : o.plan));
  std::vector<MilledModel> all;
  MDOF_TRY(const MilledModel first, mill(declared, o));
  all.push_back(first);
  if (!o.preset.empty()) {  // adds the model of a steady cut to the model of the paper
    declared.plan.deflection = DeflectionModel::steady;
    MDOF_TRY(const MilledModel steady, mill(declared, o));
    all.push_back(steady);
  }
  MDOF_CHECK(write_walls(all, o.plots));
  return o.json ? write_line(milling_json(all, o)) : write_out(milling_text(all, o));
}

Action declare_milling(CLI::App& command) {
  const auto o = std::make_shared<MillingCommand>();
  command.add_option("PLAN", o->plan, "PLAN.toml with tool, run-out, cut, force and model")
      ->type_name("");
  command
      .add_option("--preset", o->preset,
                  "Evaluate the published example of Huo et al. (2017) with their deflection "
                  "model and with the model of a steady cut")
      ->check(CLI::IsMember({kPreset}));
  command.add_flag("--offset", o->offset,
                   "Also print the radius wear offset, with u if the plan declares uncertainties");
  auto* sensitivity =
      command.add_flag("--sensitivity", o->sensitivity,
                       "Also print the effect of each input on force and wall when the input "
                       "changes by the declared u (by 1 % if no u of this input is declared)");
  command
      .add_option("--trials", o->trials,
                  "Number of trials for the sensitivity; each trial calculates the cut twice, and "
                  "once more for each input")
      ->needs(sensitivity)
      ->check(number_in(16, 1e6))
      ->capture_default_str();
  command.add_option("--seed", o->seed, "Seed of the random numbers")
      ->needs(sensitivity)
      ->check(number_in(0, 9e15))
      ->capture_default_str();
  command.add_option("--threads", o->threads, "Number of threads; the results do not depend on it")
      ->needs(sensitivity)
      ->check(CLI::Range(1, 1024));
  add_plot_option(command, o->plots);
  add_json_flag(command, o->json);
  return [o] { return milling(*o); };
}

}  // namespace

Command milling_command() {
  return {.name = "milling",
          .summary = "Calculate force, deflection and wall error of a micro end mill",
          .footer =
              "The keys of PLAN.toml are in share/doc/mdof/milling.md.\n"
              "Examples:\n"
              "  mdof milling --preset micro-end-mill\n"
              "  mdof milling plan.toml --offset",
          .declare = declare_milling};
}

}  // namespace mdof::tools
