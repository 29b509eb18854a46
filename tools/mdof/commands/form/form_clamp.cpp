// mdof form clamp BEFORE AFTER [RELEASED]: calculates how clamping deforms a surface, and whether
// the deformation stays elastic.
#include <CLI/CLI.hpp>
#include <algorithm>
#include <cmath>
#include <optional>

#include "algo/form/clamping.h"
#include "algo/form/map_figures.h"
#include "daemon/words/words.h"
#include "schema/base/json_writer.h"
#include "schema/base/number/number_text.h"
#include "schema/notice/notice_json.h"
#include "schema/units.h"
#include "tools/mdof/commands/command.h"
#include "tools/mdof/commands/form/map_file.h"
#include "tools/mdof/options.h"
#include "tools/mdof/output.h"
#include "tools/mdof/text/notice_lines.h"
#include "tools/mdof/text/text_table.h"

namespace mdof::tools {
namespace {

constexpr double kPaPerMPa = 1e6;
// The formulas are those of a thin plate.
constexpr double kThickestShare = 0.1;
constexpr double kStiffest_GPa = 2000;  // diamond: 1200 GPa

struct FormClampCommand {
  std::string before, after, released, out, plots;
  std::optional<double> K, thickness_mm, young_GPa, poisson, yield_MPa;
  double smooth_mm = 10;
  MapOptions maps;
  bool json = false;
};

struct Clamped {
  algo::ClampingParts clamping;
  std::optional<algo::PlateStress> stress;
  std::optional<bool> is_elastic;
  Notices notices;
};

// Error: the user stated only some of the data. The stress needs all data of the plate; the verdict
// also needs the yield limit.
Status check_plate(const FormClampCommand& o) {
  const std::pair<const char*, bool> plate[] = {{"--thickness-mm", o.thickness_mm.has_value()},
                                                {"--young-GPa", o.young_GPa.has_value()},
                                                {"--poisson", o.poisson.has_value()}};
  std::string given, missing;
  for (const auto& [name, is_given] : plate)
    (is_given ? given : missing) +=
        std::string((is_given ? given : missing).empty() ? "" : ", ") + name;
  if (o.yield_MPa) given += given.empty() ? "--yield-MPa" : ", --yield-MPa";
  if (o.young_GPa && *o.young_GPa > kStiffest_GPa)
    return fail(ErrorCode::usage,
                "--young-GPa is " + plain_number(*o.young_GPa) + ", but no material exceeds " +
                    plain_number(kStiffest_GPa) +
                    " GPa; state the modulus of elasticity in GPa (70 GPa = 70000 MPa)");
  if (!given.empty() && !missing.empty())
    return fail(ErrorCode::usage,
                "missing option " + missing + " (needed with " + given + ")" +
                    ": mdof calculates the stress from thickness, modulus and Poisson's ratio");
  return {};
}

// The smaller side of the rectangle around the measured pixels.
double width_m(const SurfaceMap& map) {
  const auto [left, right, low, high] = algo::measured_extent(map);
  return std::min(static_cast<double>(right - left) * map.dx_m,
                  static_cast<double>(high - low) * map.dy_m);
}

Result<Clamped> clamped(const FormClampCommand& o) {
  Clamped found;
  MDOF_TRY(const SurfaceMap before, load_map(o.before, o.maps));
  MDOF_TRY(const SurfaceMap after, load_map(o.after, o.maps));
  MDOF_CHECK(check_distinct({&before, &after}));
  if (!o.released.empty()) {
    MDOF_TRY(const SurfaceMap released, load_map(o.released, o.maps));
    MDOF_CHECK(check_distinct({&before, &after, &released}));
    MDOF_TRY(found.clamping, algo::clamping_by_release(before, after, released));
    found.notices = mirrored_notices(before, {&after, &released});
    if (algo::springs_past(found.clamping))
      found.notices.push_back(
          notice(NoticeCode::clamp_springs_past, o.released,
                 {{"K", found.clamping.K},
                  {"unexplained_rms_um", to_um(*found.clamping.K_unexplained_rms_m)},
                  {"remaining_rms_um", to_um(algo::figures_of(found.clamping.plastic).rms_m)}}));
  } else {
    MDOF_TRY(found.clamping, algo::clamping_by_K(before, after, o.K.value_or(0)));
    found.notices = mirrored_notices(before, {&after});
  }
  warn_few_common_pixels(before, algo::figures_of(found.clamping.clamping).pixels,
                         "the clamping deformation at the remaining pixels is unknown");
  if (!o.thickness_mm) return found;
  const algo::Plate plate{from_mm(*o.thickness_mm), *o.young_GPa * 1e9, *o.poisson};
  // Only the elastic deformation causes stress. The plastic deformation remains without a load.
  auto stress = algo::plate_stress(found.clamping.elastic, plate, from_mm(o.smooth_mm));
  if (!stress) return in_context("--smooth-mm", std::move(stress.error()));
  found.stress = *stress;
  if (const double width = width_m(found.clamping.elastic);
      plate.thickness_m > kThickestShare * width)
    found.notices.push_back(
        notice(NoticeCode::plate_too_thick, "",
               {{"thickness_mm", *o.thickness_mm}, {"width_mm", to_mm(width)}}));
  if (o.yield_MPa) found.is_elastic = found.stress->max_Pa < *o.yield_MPa * kPaPerMPa;
  return found;
}

void write_part(JsonWriter& json, const char* key, const SurfaceMap& part) {
  const algo::MapFigures figures = algo::figures_of(part);
  write_um(json, key, figures.pv_m, figures.rms_m);
}

std::string clamp_json(const Clamped& found, const FormClampCommand& o) {
  JsonWriter json;
  json.begin_object();
  write_part(json, "clamping", found.clamping.clamping);
  write_part(json, "elastic", found.clamping.elastic);
  write_part(json, "plastic", found.clamping.plastic);
  json.field("K", found.clamping.K)
      .field("K_source", !o.released.empty() ? "measured"
                         : o.K               ? "given"
                               : "assumed: the whole clamping deformation is elastic");
  if (found.clamping.K_unexplained_rms_m)
    json.field("K_unexplained_rms_um", to_um(*found.clamping.K_unexplained_rms_m));
  else
    json.key("K_unexplained_rms_um").null();
  json.field("pixels",
             static_cast<std::uint64_t>(algo::figures_of(found.clamping.clamping).pixels));
  if (found.stress) {
    json.field("stress_max_MPa", found.stress->max_Pa / kPaPerMPa)
        .key("stress_at")
        .begin_object()
        .field("x_mm", to_mm(found.stress->x_m))
        .field("y_mm", to_mm(found.stress->y_m))
        .end_object()
        .field("smooth_mm", o.smooth_mm);
  } else {
    json.key("stress_max_MPa").null();
    json.field("stress_reason",
               "thickness and material of the part are unknown; give --thickness-mm, --young-GPa "
               "and --poisson");
  }
  json.key("is_elastic");
  if (found.is_elastic)
    json.value(*found.is_elastic);
  else
    json.null();
  write_notices(json, "notices", found.notices, words::text);
  json.end_object();
  return json.take();
}

std::string clamp_text(const Clamped& found, const FormClampCommand& o) {
  TextTable table({"", "PV/µm", "RMS/µm"});
  const auto add = [&](const char* name, const SurfaceMap& part) {
    const algo::MapFigures figures = algo::figures_of(part);
    table.add({name, in_um(figures.pv_m), in_um(figures.rms_m)});
  };
  add("clamping", found.clamping.clamping);
  add("elastic", found.clamping.elastic);
  add("plastic", found.clamping.plastic);
  std::string text = table.text() + "K = " + plain_number(found.clamping.K) +
                     (!o.released.empty() ? ", measured"
                      : o.K               ? ", given"
                            : ", assumed: the whole clamping deformation is elastic") +
                     "; piston and tilt are removed\n";
  if (found.clamping.K_unexplained_rms_m)
    text += "plastic deformation minus K times the elastic deformation: RMS " +
            in_um(*found.clamping.K_unexplained_rms_m) + " µm\n";
  if (!found.stress) return text;
  text += "largest stress of the elastic deformation " +
          fixed(found.stress->max_Pa / kPaPerMPa, 3) + " MPa (von Mises) at x " +
          in_mm(found.stress->x_m) + " mm, y " + in_mm(found.stress->y_m) +
          " mm; curvature fitted over squares of " + plain_number(o.smooth_mm) + " mm\n";
  if (found.is_elastic)
    text += std::string(*found.is_elastic ? "elastic: the largest stress is below"
                                          : "NOT ELASTIC: the largest stress is not below") +
            " the yield limit of " + plain_number(*o.yield_MPa) + " MPa\n";
  return text;
}

Status form_clamp(const FormClampCommand& o) {
  MDOF_CHECK(check_plate(o));
  MDOF_CHECK(check_out(o.out, {o.before, o.after, o.released}));
  if (o.K && !o.released.empty())
    return fail(ErrorCode::usage,
                "RELEASED and --K exclude each other, because mdof calculates K (plastic / elastic "
                "deformation) from the map RELEASED; leave out RELEASED or --K");
  MDOF_TRY(const Clamped found, clamped(o));
  show_notices(found.notices, true);
  if (o.released.empty() && !o.K)
    warn(
        "neither RELEASED nor --K is given, so mdof assumes that the whole clamping deformation is "
        "elastic (K = 0)");
  MDOF_CHECK(save_maps(found.clamping.elastic, o.out,
                       {{"clamping", "Deformation by clamping", found.clamping.clamping},
                        {"elastic", "Elastic part of the deformation", found.clamping.elastic},
                        {"plastic", "Plastic part of the deformation", found.clamping.plastic}},
                       o.plots));
  MDOF_CHECK(o.json ? write_line(clamp_json(found, o)) : write_out(clamp_text(found, o)));
  if (!found.is_elastic || *found.is_elastic) return {};
  return fail(ErrorCode::check, o.after + ": the clamping stress of " +
                                    plain_number(found.stress->max_Pa / kPaPerMPa) +
                                    " MPa is not below the yield limit of " +
                                    plain_number(*o.yield_MPa) + " MPa; clamp with less force");
}

Action declare_form_clamp(CLI::App& command) {
  const auto o = std::make_shared<FormClampCommand>();
  command.add_option("BEFORE", o->before, "Height map of the part before clamping")
      ->required()
      ->type_name("");
  command.add_option("AFTER", o->after, "Height map of the clamped part")
      ->required()
      ->type_name("");
  command
      .add_option("RELEASED", o->released,
                  "Height map of the part after release; mdof calculates K from this map")
      ->type_name("");
  command.add_option("--K", o->K, "Ratio of plastic to elastic deformation [default: 0]")
      ->check(finite_number());
  command.add_option("--thickness-mm", o->thickness_mm, "Thickness of the part")
      ->check(positive_number());
  command.add_option("--young-GPa", o->young_GPa, "Modulus of elasticity of the part")
      ->check(positive_number());
  command.add_option("--poisson", o->poisson, "Poisson's ratio of the part")
      ->check(number_in(0, 0.5));
  command
      .add_option("--yield-MPa", o->yield_MPa,
                  "Yield limit of the part; exit code 1 if the stress reaches this limit")
      ->check(positive_number());
  command
      .add_option("--smooth-mm", o->smooth_mm,
                  "Side length of the squares over which mdof fits the curvature; if the squares "
                  "are small, pixel noise increases the calculated stress")
      ->check(positive_number())
      ->capture_default_str();
  command
      .add_option("--out", o->out,
                  "Write the elastic deformation to this file as a height map (CSV)")
      ->type_name("FILE");
  add_map_options(command, o->maps);
  add_plot_option(command, o->plots);
  add_json_flag(command, o->json);
  return [o] { return form_clamp(*o); };
}

}  // namespace

Command form_clamp_command() {
  return {
      .name = "form clamp",
      .summary = "Calculate elastic and plastic deformation by clamping, and stress in the part",
      .footer =
          "Example:\n"
          "  mdof form clamp before.csv clamped.csv --thickness-mm 2.5 --young-GPa 70 "
          "--poisson 0.33 --yield-MPa 275 --out elastic.csv",
      .declare = declare_form_clamp};
}

}  // namespace mdof::tools
