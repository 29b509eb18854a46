// mdof form compare A B: calculates the difference between two maps.
#include <CLI/CLI.hpp>
#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>

#include "algo/form/clamping.h"
#include "algo/form/registration.h"
#include "daemon/words/words.h"
#include "schema/base/json_writer.h"
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

struct FormCompareCommand {
  std::string a, b, register_how = "rigid", out, plots;
  MapOptions maps;
  bool json = false;
};

algo::Register register_from(const std::string& name) {
  return name == "rigid"   ? algo::Register::rigid
         : name == "plane" ? algo::Register::plane
                           : algo::Register::none;
}

struct Compared {
  algo::Comparison found;
  // Set if B, mirrored, is closer to A than in the pose found.
  std::optional<algo::MirroredMatch> mirrored;
  algo::MapPose pose;  // with the shift of the middle of A
  double x_middle_m = 0, y_middle_m = 0;
  std::size_t measured = 0;  // pixels of A
  double pixel_m = 0;        // smaller pitch of A in x and y
};

// The movement of B as a shift of the middle of A and a turn about it. About (0, 0), a small turn
// of a map that is far away from (0, 0) would need a large shift.
void set_pose_about_middle(const SurfaceMap& a, Compared& compared) {
  const double x = (a.x_m(0) + a.x_m(a.nx - 1)) / 2, y = (a.y_m(0) + a.y_m(a.ny - 1)) / 2;
  const algo::MapPose& pose = compared.found.pose;
  const double sin = std::sin(pose.turn_rad), half = std::sin(pose.turn_rad / 2),
               less = 2 * half * half;  // 1 - cos
  compared.pose = {pose.shift_x_m - less * x - sin * y, pose.shift_y_m + sin * x - less * y,
                   pose.turn_rad};
  compared.x_middle_m = x;
  compared.y_middle_m = y;
}

// Limits for notices. Noise and small differences in form shift the best pose by less than a pixel;
// such a shift needs no notice.
constexpr double kPixelsMoved = 1, kMuchLeft = 0.5;

Notices notices_of(const Compared& compared, const FormCompareCommand& o) {
  const algo::Comparison& found = compared.found;
  Notices notices;
  if (has_few_common_pixels(found.pixels, compared.measured))
    notices.push_back(notice(NoticeCode::map_pixels_not_compared, o.a,
                             {{"compared", found.pixels}, {"measured", compared.measured}}));
  if (compared.mirrored)
    notices.push_back(notice(NoticeCode::map_matches_mirrored, o.b,
                             {{"mirrored", compared.mirrored->mirrored},
                              {"rms_um", to_um(found.rms_m)},
                              {"mirrored_rms_um", to_um(compared.mirrored->mirrored_rms_m)}}));
  if (found.undetermined > 0) {
    // With fewer common pixels, mdof does not accept a movement.
    const bool has_overlap = static_cast<double>(found.pixels) >=
                             algo::kRegistrationOverlap * static_cast<double>(compared.measured);
    notices.push_back(notice(
        has_overlap ? NoticeCode::map_movements_undetermined : NoticeCode::map_overlap_too_small,
        o.a, {{"directions", found.undetermined}}));
  }
  if (found.moved_m > kPixelsMoved * compared.pixel_m && found.residual_ratio > kMuchLeft)
    notices.push_back(
        notice(NoticeCode::map_movement_gains_little, o.b,
               {{"moved_mm", to_mm(found.moved_m)},
                {"removed_percent", std::max(0.0, 100 * (1 - found.residual_ratio))}}));
  return notices;
}

// The search takes several seconds for the largest maps.
constexpr std::size_t kMostForMirrored = 4'000'000;
// The first search of the registration turns B by up to 10 degrees. A mirrored map may match better
// in a larger turn that is false.
constexpr double kFarTurn_rad = 10 * std::numbers::pi / 180;

std::optional<algo::MirroredMatch> mirrored_match(const SurfaceMap& a, const SurfaceMap& b,
                                                  const algo::Comparison& found) {
  const bool is_far_turned = std::abs(found.pose.turn_rad) > kFarTurn_rad;
  if (b.z_m.size() > kMostForMirrored || (found.residual_ratio <= kMuchLeft && !is_far_turned))
    return {};
  const auto match = algo::mirrored_match(a, b);
  return match && match->mirrored_rms_m < kMuchLeft * found.rms_m ? match : std::nullopt;
}

std::string compare_json(const Compared& compared, const FormCompareCommand& o) {
  const algo::Comparison& found = compared.found;
  JsonWriter json;
  json.begin_object()
      .field("pv_um", to_um(found.pv_m))
      .field("rms_um", to_um(found.rms_m))
      .key("shift_mm")
      .begin_array()
      .value(to_mm(compared.pose.shift_x_m))
      .value(to_mm(compared.pose.shift_y_m))
      .end_array()
      .field("turn_deg", compared.pose.turn_rad * 180 / std::numbers::pi)
      .key("middle_mm")
      .begin_array()
      .value(to_mm(compared.x_middle_m))
      .value(to_mm(compared.y_middle_m))
      .end_array()
      .field("pixels", static_cast<std::uint64_t>(found.pixels))
      .field("register", o.register_how)
      .field("undetermined_directions", static_cast<std::uint64_t>(found.undetermined));
  write_notices(json, "notices", notices_of(compared, o), words::text);
  json.end_object();
  return json.take();
}

std::string compare_text(const Compared& compared, const FormCompareCommand& o) {
  const algo::Comparison& found = compared.found;
  std::string text = o.b + " - " + o.a + ": PV " + in_um(found.pv_m) + " µm, RMS " +
                     in_um(found.rms_m) + " µm about the mean, " + std::to_string(found.pixels) +
                     " pixels\n";
  if (o.register_how == "rigid")
    text += "relative to A, B is shifted by x " + in_mm(compared.pose.shift_x_m) + " mm, y " +
            in_mm(compared.pose.shift_y_m) + " mm and turned by " +
            fixed(compared.pose.turn_rad * 180 / std::numbers::pi, 5) +
            "° about the middle of A (x " + in_mm(compared.x_middle_m) + " mm, y " +
            in_mm(compared.y_middle_m) + " mm)\n";
  if (o.register_how != "none") text += "piston and tilt are removed\n";
  return text;
}

Status form_compare(const FormCompareCommand& o) {
  MDOF_CHECK(check_out(o.out, {o.a, o.b}));
  MDOF_TRY(const SurfaceMap a, load_map(o.a, o.maps));
  MDOF_TRY(const SurfaceMap b, load_map(o.b, o.maps));
  if (are_identical(a, b))
    warn(o.b + ": this map is identical to " + o.a +
         ", so one measurement was probably given twice");
  Compared compared;
  MDOF_TRY(compared.found, algo::compare(a, b, register_from(o.register_how)));
  compared.measured = a.measured();
  compared.pixel_m = std::min(a.dx_m, a.dy_m);
  set_pose_about_middle(a, compared);
  compared.mirrored = mirrored_match(a, b, compared.found);
  const algo::Comparison& found = compared.found;
  show_notices(notices_of(compared, o), true);
  MDOF_CHECK(save_maps(found.difference, o.out,
                       {{"difference", o.b + " - " + o.a, found.difference}}, o.plots));
  return o.json ? write_line(compare_json(compared, o)) : write_out(compare_text(compared, o));
}

Action declare_form_compare(CLI::App& command) {
  const auto o = std::make_shared<FormCompareCommand>();
  command
      .add_option("A", o->a,
                  "Height map A: CSV with the columns x_mm,y_mm,z_um, or XYZ, .sdf or Zygo .dat")
      ->required()
      ->type_name("");
  command.add_option("B", o->b, "Height map B, which mdof compares with A")
      ->required()
      ->type_name("");
  command
      .add_option("--register", o->register_how,
                  "Movements that mdof removes from B before the comparison: rigid (shift, turn, "
                  "piston, tilt), plane (piston, tilt) or none")
      ->check(CLI::IsMember({"rigid", "plane", "none"}))
      ->capture_default_str();
  command.add_option("--out", o->out, "Write the difference to this file as a height map (CSV)")
      ->type_name("FILE");
  add_map_options(command, o->maps);
  add_plot_option(command, o->plots);
  add_json_flag(command, o->json);
  return [o] { return form_compare(*o); };
}

}  // namespace

Command form_compare_command() {
  return {.name = "form compare",
          .summary = "Calculate the difference of two height maps of a surface",
          .footer =
              "The shift is the position of B relative to A at the middle of map A (between its "
              "first and last pixel in x and y). B is turned about this middle.\n"
              "Examples:\n"
              "  mdof form compare before.csv after.csv\n"
              "  mdof form compare wanted.sdf cut.dat --register plane --json",
          .declare = declare_form_compare};
}

}  // namespace mdof::tools
