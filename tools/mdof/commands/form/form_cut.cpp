// mdof form cut WANTED CUT... --out NEXT: calculates the path of the next pass from the measured
// surfaces of the passes so far.
#include <CLI/CLI.hpp>
#include <cmath>
#include <string>
#include <vector>

#include "algo/form/cutting.h"
#include "algo/form/map_figures.h"
#include "algo/form/registration.h"
#include "daemon/words/words.h"
#include "schema/base/json_writer.h"
#include "schema/base/number/number_text.h"
#include "schema/notice/notice_json.h"
#include "schema/units.h"
#include "tools/mdof/commands/command.h"
#include "tools/mdof/commands/form/map_file.h"
#include "tools/mdof/options.h"
#include "tools/mdof/output.h"
#include "tools/mdof/terminal.h"
#include "tools/mdof/text/notice_lines.h"
#include "tools/mdof/text/text_table.h"

namespace mdof::tools {
namespace {

constexpr const char* kOnePass =
    "only one pass: the repeatable part of the error is unknown; cut once more with the same path";

struct FormCutCommand {
  std::string wanted, gain = "1", out, plots;
  std::vector<std::string> cuts;
  bool repeated = false, json = false;
  double smooth_mm = 0;
  std::optional<double> random_um;
  MapOptions maps;
};

void write_optional(JsonWriter& json, const char* key, const std::optional<double>& x_m) {
  json.key(key);
  if (x_m)
    json.value(to_um(*x_m));
  else
    json.null();
}

struct FoundCut {
  algo::CuttingResult result;
  std::size_t without_next = 0;  // measured pixels of WANTED without a height in the next path
  Notices notices;
};

constexpr double kNoForm_m = 1e-12;  // a smaller RMS is rounding

// A notice for each pass whose map is not closer to the wanted map than a plane is. A pass that
// follows its path is closer, unless its error is larger than the wanted form.
Result<Notices> unlike_notices(const algo::CuttingPasses& passes) {
  Notices notices;
  for (const SurfaceMap& cut : passes.cuts) {
    MDOF_TRY(SurfaceMap error, algo::difference(passes.wanted, cut));
    SurfaceMap wanted = passes.wanted;
    for (std::size_t k = 0; k < wanted.z_m.size(); ++k)
      if (std::isnan(error.z_m[k])) wanted.z_m[k] = SurfaceMap::kMissing;
    algo::remove_plane(error);
    algo::remove_plane(wanted);
    const double error_m = algo::figures_of(error).rms_m, wanted_m = algo::figures_of(wanted).rms_m;
    if (wanted_m > kNoForm_m && error_m >= wanted_m)
      notices.push_back(notice(NoticeCode::cut_unlike_wanted, cut.name,
                               {{"rms_um", to_um(error_m)}, {"wanted_rms_um", to_um(wanted_m)}}));
  }
  return notices;
}

Result<FoundCut> found_cut(const algo::CuttingPasses& passes) {
  FoundCut found;
  MDOF_TRY(found.result, algo::next_cut(passes));
  for (std::size_t k = 0; k < passes.wanted.z_m.size(); ++k)
    if (!std::isnan(passes.wanted.z_m[k]) && std::isnan(found.result.next.z_m[k]))
      ++found.without_next;
  std::vector<const SurfaceMap*> cuts;
  for (const SurfaceMap& cut : passes.cuts) cuts.push_back(&cut);
  found.notices = mirrored_notices(passes.wanted, cuts);
  MDOF_TRY(const Notices unlike, unlike_notices(passes));
  found.notices.insert(found.notices.end(), unlike.begin(), unlike.end());
  return found;
}

std::string cut_json(const FoundCut& cut, const FormCutCommand& o) {
  const algo::CuttingResult& found = cut.result;
  JsonWriter json;
  json.begin_object().key("error").begin_array();
  for (const algo::MapFigures& error : found.error)
    json.begin_object()
        .field("pv_um", to_um(error.pv_m))
        .field("rms_um", to_um(error.rms_m))
        .field("mean_um", to_um(error.mean_m))
        .end_object();
  json.end_array();
  write_optional(json, "repeatable_rms_um", found.repeatable_rms_m);
  write_optional(json, "random_rms_um", found.random_rms_m);
  json.key("floor_rms_um").begin_object();
  write_optional(json, "gain_1", found.floor_gain_one_m);
  write_optional(json, "mean", found.floor_mean_m);
  write_optional(json, "optimal", found.floor_optimal_m);
  json.end_object().key("converges");
  if (found.converges)
    json.value(*found.converges);
  else
    json.null();
  if (!found.converges) json.field("converges_reason", kOnePass);
  write_optional(json, "left_by_smoothing_rms_um", found.left_by_smoothing_rms_m);
  json.field("gain", o.gain)
      .key("factor")
      .value(found.factor.value_or(1))
      .field("smooth_mm", o.smooth_mm)
      .field("repeated", o.repeated)
      .field("pixels", static_cast<std::uint64_t>(found.pixels))
      .field("pixels_without_next", static_cast<std::uint64_t>(cut.without_next))
      .field("next", o.out);
  write_notices(json, "notices", cut.notices, words::text);
  json.end_object();
  return json.take();
}

std::string cut_text(const FoundCut& cut, const FormCutCommand& o) {
  const algo::CuttingResult& found = cut.result;
  const std::string next = "next path: " + o.out + ", " + std::to_string(cut.without_next) +
                           " of the measured pixels of WANTED have no height in it\n";
  TextTable table({"pass", "PV/µm", "RMS/µm", "mean/µm"});
  for (std::size_t k = 0; k < found.error.size(); ++k)
    table.add({std::to_string(k + 1), in_um(found.error[k].pv_m), in_um(found.error[k].rms_m),
               in_um(found.error[k].mean_m)});
  std::string text =
      "error = CUT - WANTED (measured - nominal); RMS is about the mean\n" + table.text() +
      wrapped(
          "The next path also corrects the mean and the tilt of the error. If the instrument does "
          "not measure mean and tilt relative to the machine, remove both from the maps.",
          terminal_columns()) +
      "\n";
  if (found.factor)
    text += "optimal gain " + fixed(*found.factor, 4) +
            ": the correction of the next path is the mean error of all passes times this gain\n";
  if (found.left_by_smoothing_rms_m)
    text += "error that the next path does not correct because of the smoothing (squares of " +
            plain_number(o.smooth_mm) + " mm): RMS " + in_um(*found.left_by_smoothing_rms_m) +
            " µm\n";
  if (!found.converges) return text + kOnePass + "\n" + next;
  text +=
      "repeatable error: RMS " + in_um(*found.repeatable_rms_m) + " µm; random error: RMS " +
      in_um(*found.random_rms_m) +
      " µm per pass\n"
      "lowest RMS error that further passes can reach" +
      (o.smooth_mm > 0 ? " without --smooth-mm: " : ": ") + in_um(*found.floor_gain_one_m) +
      " µm (--gain 1), " + in_um(*found.floor_mean_m) + " µm (--gain mean)" +
      (found.floor_optimal_m ? ", " + in_um(*found.floor_optimal_m) + " µm (--gain optimal)" : "") +
      "\n" + (*found.converges ? "the passes converge" : "THE PASSES DO NOT CONVERGE") + "\n" +
      next;
  return text;
}

Status form_cut(const FormCutCommand& o) {
  if (o.gain == "optimal" && !o.random_um && (!o.repeated || o.cuts.size() < 2))
    return fail(ErrorCode::usage,
                "--gain optimal: the random error of a pass is unknown; give --random-um, or two "
                "or more passes with --repeated");
  if (o.gain != "optimal" && o.random_um)
    return fail(ErrorCode::usage,
                "--random-um is used only with --gain optimal; add --gain optimal, or leave out "
                "--random-um");
  MDOF_CHECK(check_out(o.out, {o.wanted}));
  MDOF_CHECK(check_out(o.out, o.cuts));
  algo::CuttingPasses passes;
  MDOF_TRY(passes.wanted, load_map(o.wanted, o.maps));
  for (const std::string& file : o.cuts) {
    MDOF_TRY(SurfaceMap cut, load_map(file, o.maps));
    passes.cuts.push_back(std::move(cut));
  }
  std::vector<const SurfaceMap*> maps{&passes.wanted};
  for (const SurfaceMap& cut : passes.cuts) maps.push_back(&cut);
  MDOF_CHECK(check_distinct(maps));
  passes.repeated = o.repeated;
  passes.gain = o.gain == "mean"      ? algo::CuttingGain::mean
                : o.gain == "optimal" ? algo::CuttingGain::optimal
                                      : algo::CuttingGain::one;
  if (o.random_um) passes.random_rms_m = from_um(*o.random_um);
  passes.smooth_m = from_mm(o.smooth_mm);
  MDOF_TRY(const FoundCut found, found_cut(passes));
  show_notices(found.notices, true);
  warn_few_common_pixels(passes.wanted, found.result.pixels,
                         "the next path has no height at the remaining pixels (\"mdof form path\" "
                         "bridges these gaps)");
  MDOF_CHECK(save_maps(found.result.next, o.out,
                       {{"next-path", "Path of the next pass", found.result.next}}, o.plots));
  return o.json ? write_line(cut_json(found, o)) : write_out(cut_text(found, o));
}

Action declare_form_cut(CLI::App& command) {
  const auto o = std::make_shared<FormCutCommand>();
  command
      .add_option("WANTED", o->wanted,
                  "Nominal height map, which is also the path of the first pass")
      ->required()
      ->type_name("");
  command
      .add_option("CUT", o->cuts,
                  "Height maps measured after each pass, in the order of the passes")
      ->required()
      ->type_name("");
  command.add_flag("--repeated", o->repeated,
                   "All passes used the path of the first pass [default: each pass used its own "
                   "corrected path]");
  command
      .add_option(
          "--gain", o->gain,
          "Error that the next path corrects: error of the last pass (\"1\"), mean error of "
          "all passes (\"mean\"), or repeatable share of the mean error (\"optimal\")")
      ->check(CLI::IsMember({"1", "mean", "optimal"}))
      ->capture_default_str();
  command
      .add_option("--random-um", o->random_um,
                  "RMS of the random error of a pass, for --gain optimal [default: estimated from "
                  "--repeated passes]")
      ->check(not_negative_number());
  command
      .add_option("--smooth-mm", o->smooth_mm,
                  "Side length of the squares over which mdof smooths the correction, so that "
                  "pixel noise is not cut into the part; 0: no smoothing")
      ->check(not_negative_number())
      ->capture_default_str();
  command
      .add_option("--out", o->out,
                  "Write the path of the next pass to this file as a height map (CSV)")
      ->required()
      ->type_name("FILE");
  add_map_options(command, o->maps);
  add_plot_option(command, o->plots);
  add_json_flag(command, o->json);
  return [o] { return form_cut(*o); };
}

}  // namespace

Command form_cut_command() {
  return {.name = "form cut",
          .summary = "Calculate the path of the next pass from the errors of the previous passes",
          .footer =
              "Without --repeated, mdof assumes that this command wrote the path of each pass, "
              "with the same --gain, --random-um and --smooth-mm.\n"
              "Example:\n"
              "  mdof form cut wanted.csv cut1.csv --out path2.csv",
          .declare = declare_form_cut};
}

}  // namespace mdof::tools
