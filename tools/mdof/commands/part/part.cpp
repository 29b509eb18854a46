// mdof part PART.toml: calculates the error of a part along its path, its causes, and their
// compensation.
#include <CLI/CLI.hpp>
#include <algorithm>
#include <cmath>
#include <numeric>
#include <string>
#include <vector>

#include "algo/part/part_error.h"
#include "daemon/words/words.h"
#include "schema/base/append_new.h"
#include "schema/notice/notice_json.h"
#include "schema/run_json.h"
#include "schema/units.h"
#include "tools/mdof/commands/command.h"
#include "tools/mdof/commands/machine/machine_file.h"
#include "tools/mdof/commands/part/part_layers.h"
#include "tools/mdof/options.h"
#include "tools/mdof/output.h"
#include "tools/mdof/terminal.h"
#include "tools/mdof/text/notice_lines.h"
#include "tools/mdof/text/run_tables.h"
#include "tools/mdof/text/text_table.h"

namespace mdof::tools {
namespace {

struct PartCommand {
  std::string file, database;
  bool json = false;
};

struct FoundPart {
  LoadedPart part;
  algo::PartError error, left;
  std::vector<std::size_t> layers, causes;  // indices, the largest share first
};

std::vector<std::size_t> ranked(const std::vector<algo::PartShare>& shares) {
  std::vector<std::size_t> order(shares.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::stable_sort(order.begin(), order.end(),
                   [&](std::size_t a, std::size_t b) { return shares[a].share > shares[b].share; });
  return order;
}

// If a cause has no u, a U or a residual of exactly 0 would be wrong: it would count the missing u
// as 0. Sets such figures to NaN (unknown).
void clear_unknown_figures(FoundPart& found) {
  if (found.part.no_u.empty()) return;
  const auto forget = [](double& x) {
    if (x == 0) x = std::nan("");
  };
  const auto forget_point = [](algo::Interval& interval) {
    if (interval.low == interval.high) interval = {std::nan(""), std::nan("")};
  };
  forget_point(found.error.p95_interval_m);
  forget_point(found.error.max_interval_m);
  for (auto* shares : {&found.error.layers, &found.error.causes})
    for (algo::PartShare& share : *shares) {
      forget_point(share.rms_interval_m);
      forget_point(share.share_interval);
    }
  for (algo::PartShare& left : found.left.layers) forget(left.rms_m);
  // Only the u of a compensated layer remains.
  for (std::size_t k = 0; k < found.part.layers.size(); ++k) {
    if (!found.part.layers[k].plan.compensated) continue;
    for (double* x : {&found.error.p95_m, &found.error.max_m, &found.error.layers[k].rms_m,
                      &found.error.layers[k].share})
      forget(*x);
    for (std::size_t c = 0; c < found.part.causes.size(); ++c)
      if (found.part.causes[c].layer == k)
        for (double* x : {&found.error.causes[c].rms_m, &found.error.causes[c].share}) forget(*x);
  }
}

algo::Interval in_unit(const algo::Interval& interval_m) {
  return {to_um(interval_m.low), to_um(interval_m.high)};
}

// Writes a value, its U and its interval. NaN: unknown.
void write_figure(JsonWriter& json, const std::string& name, double value,
                  const algo::Interval& interval) {
  json.field(name, value).field("U_" + name, interval.U(value)).key("interval_" + name);
  if (std::isnan(interval.low))
    json.null();
  else
    json.begin_array().value(interval.low).value(interval.high).end_array();
}

void write_share(JsonWriter& json, const algo::PartShare& share) {
  write_figure(json, "share", share.share, share.share_interval);
  write_figure(json, "rms_um", to_um(share.rms_m), in_unit(share.rms_interval_m));
}

// Number of points of the path at which the layer has no value; the value 0 is used there.
std::uint64_t uncovered_point_count(const LoadedPart& part, const std::string& layer) {
  for (const Notice& each : part.notices)
    if (each.code == NoticeCode::map_lacks_points && each.subject == layer)
      return part.points_off_form_map;
  return 0;
}

std::string notices_text(const LoadedPart& part) {
  std::string text;
  for (const Notice& each : part.notices)
    text += wrapped(words::text(each), terminal_columns()) + "\n";
  return text;
}

std::string part_json(const FoundPart& found) {
  const LoadedPart& part = found.part;
  JsonWriter json;
  json.begin_object()
      .field("name", part.plan.name)
      .field("machine", part.machine.name)
      .field("simulated", part.machine.simulated)
      .field("noise_only", noise_only(part.machine) == NoiseOnly::all)
      .field("points", static_cast<std::uint64_t>(part.path.at_m.size()))
      .field("along_normals", !part.path.normal.empty())
      .key("error_um")
      .begin_object();
  write_figure(json, "p95", to_um(found.error.p95_m), in_unit(found.error.p95_interval_m));
  write_figure(json, "max", to_um(found.error.max_m), in_unit(found.error.max_interval_m));
  json.end_object().key("layers").begin_array();
  for (const std::size_t k : found.layers) {
    const LoadedLayer& layer = part.layers[k];
    json.begin_object().field("name", layer.plan.name);
    write_share(json, found.error.layers[k]);
    json.field("compensated", layer.plan.compensated).key("compensated_by");
    if (layer.compensated_by.empty())
      json.null();
    else
      json.value(layer.compensated_by);
    json.field("left_um", to_um(found.left.layers[k].rms_m))
        .field("points_lacking", uncovered_point_count(part, layer.plan.name))
        .end_object();
  }
  json.end_array().key("causes").begin_array();
  for (const std::size_t k : found.causes) {
    json.begin_object()
        .field("name", part.causes[k].name)
        .field("layer", part.layers[part.causes[k].layer].plan.name);
    write_share(json, found.error.causes[k]);
    json.end_object();
  }
  const Eigen::Vector3d& worst = part.path.at_m[found.error.worst];
  json.end_array()
      .key("worst")
      .begin_object()
      .field("x_mm", to_mm(worst(0)))
      .field("y_mm", to_mm(worst(1)))
      .field("z_mm", to_mm(worst(2)))
      .end_object();
  write_strings(json, "not_measured", part.not_measured);
  write_strings(json, "not_declared", part.no_u);
  write_strings(json, "beyond_tables", part.beyond_tables);
  write_strings(json, "tables_without_slope", part.tables_without_slope);
  json.key("unknown_approach").begin_array();
  for (const auto& [axis, points] : part.unknown_approach)
    json.begin_object()
        .field("axis", axis)
        .field("points", static_cast<std::uint64_t>(points))
        .end_object();
  json.end_array();
  json.field("points_off_form_map", static_cast<std::uint64_t>(part.points_off_form_map));
  Notices notices = part.machine.notices;
  append_new(notices, part.notices);
  write_notices(json, "notices", notices, words::text);
  json.end_object();
  return json.take();
}

bool has_only_u(const algo::PartCause& cause) {
  const auto is_zero = [](const Eigen::Vector3d& v) { return v.isZero(0); };
  return std::all_of(cause.value_m.begin(), cause.value_m.end(), is_zero) &&
         !std::all_of(cause.u_m.begin(), cause.u_m.end(), is_zero);
}

// Facts about the approaches of the axes and about causes whose value is unknown.
std::string assumptions_text(const LoadedPart& part) {
  std::string text;
  for (const auto& [axis, points] : part.unknown_approach)
    text +=
        wrapped("axis " + axis + ": the approach is unknown at " + std::to_string(points) +
                    (points == 1 ? " point" : " points") +
                    " of the path, because the axis has not moved yet; mdof uses the mean of both "
                    "approaches there",
                terminal_columns()) +
        "\n";
  if (std::any_of(part.causes.begin(), part.causes.end(), has_only_u))
    text += wrapped(
                "Some causes have an uncertainty u, but no value. For such a cause and for its "
                "layer, RMS is the root of the expected mean square. The largest error and the "
                "error of 95 % of the points are medians of the trials. Therefore this RMS can be "
                "larger than both of them.",
                terminal_columns()) +
            "\n";
  return text;
}

std::string share_text(double share) {
  return fixed(100 * share, 1);
}

std::string interval_text(const std::string& low, const std::string& high) {
  return low == "-" ? low : low + " to " + high;
}
std::string shares_text(const algo::Interval& shares) {
  return interval_text(share_text(shares.low), share_text(shares.high));
}
std::string um_text(const algo::Interval& interval_m) {
  return interval_text(in_um(interval_m.low), in_um(interval_m.high));
}

std::string part_text(const FoundPart& found) {
  const LoadedPart& part = found.part;
  const Eigen::Vector3d& worst = part.path.at_m[found.error.worst];
  std::string text =
      noise_only_notice(noise_only(part.machine)) + simulated_notice(part.machine.simulated);
  if (!part.plan.name.empty()) text += part.plan.name + ": ";
  text +=
      "error of the part (" +
      std::string(part.path.normal.empty() ? "length of the error vector" : "along the normals") +
      ") at " + std::to_string(part.path.at_m.size()) +
      " points\n"
      "95 % of the points have an error below " +
      in_um(found.error.p95_m) + " µm (" + um_text(found.error.p95_interval_m) +
      "); the largest error is " + in_um(found.error.max_m) + " µm (" +
      um_text(found.error.max_interval_m) + "); the error is largest at x " + in_mm(worst(0)) +
      ", y " + in_mm(worst(1)) + ", z " + in_mm(worst(2)) + " mm\n";
  TextTable layers({"layer", "share/%", "95 %", "RMS/µm", "95 %", "residual/µm", "corrected by"});
  for (const std::size_t k : found.layers) {
    const algo::PartShare& share = found.error.layers[k];
    layers.add({part.layers[k].plan.name, share_text(share.share),
                shares_text(share.share_interval), in_um(share.rms_m),
                um_text(share.rms_interval_m), in_um(found.left.layers[k].rms_m),
                part.layers[k].compensated_by});
  }
  TextTable causes({"cause", "layer", "share/%", "95 %", "RMS/µm"});
  for (const std::size_t k : found.causes)
    causes.add({part.causes[k].name, part.layers[part.causes[k].layer].plan.name,
                share_text(found.error.causes[k].share),
                shares_text(found.error.causes[k].share_interval),
                in_um(found.error.causes[k].rms_m)});
  return text + "\n" + layers.text(terminal_columns()) + "\n" + causes.text(terminal_columns()) +
         "share: contribution of a layer or cause to the sum of all mean square errors\n"
         "95 %: interval that contains the true value with a probability of 95 %\n"
         "residual: RMS of the error that remains after the compensation of the layer\n" +
         assumptions_text(part) + notices_text(part) +
         missing_text(part.not_measured, part.no_u, terminal_columns());
}

Status part(const PartCommand& o) {
  FoundPart found;
  MDOF_TRY(found.part, load_part(o.file, o.database));
  const std::size_t layers = found.part.layers.size();
  found.error = algo::part_error(found.part.path, found.part.causes, layers);
  algo::PartTrials none;
  none.shares = none.errors = 0;
  found.left = algo::part_error(found.part.path, found.part.left, layers, none);
  found.layers = ranked(found.error.layers);
  found.causes = ranked(found.error.causes);
  clear_unknown_figures(found);
  show_notices(found.part.notices, true);
  return o.json ? write_line(part_json(found)) : write_out(part_text(found));
}

Action declare_part(CLI::App& command) {
  const auto o = std::make_shared<PartCommand>();
  command
      .add_option("PART", o->file,
                  "PART.toml with machine, path and layers (axes, budget, form, milling)")
      ->required()
      ->type_name("");
  add_database_option(command, o->database);
  add_json_flag(command, o->json);
  return [o] { return part(*o); };
}

}  // namespace

Command part_command() {
  return {
      .name = "part",
      .summary = "Calculate the error of a part along the tool path, with causes and compensation",
      .footer =
          "The keys of PART.toml are in share/doc/mdof/part.md.\n"
          "Example:\n  mdof part part.toml",
      .declare = declare_part};
}

}  // namespace mdof::tools
