// mdof form path MAP --out FILE: calculates the path of a fast tool servo over a map.
#include <CLI/CLI.hpp>
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <numbers>
#include <optional>
#include <string>

#include "algo/form/map_figures.h"
#include "algo/form/spiral_path.h"
#include "algo/form/surface.h"
#include "daemon/words/words.h"
#include "schema/base/json_writer.h"
#include "schema/base/number/number_text.h"
#include "schema/notice/notice_json.h"
#include "schema/units.h"
#include "tools/mdof/commands/command.h"
#include "tools/mdof/commands/form/map_file.h"
#include "tools/mdof/commands/form/path_motion.h"
#include "tools/mdof/commands/form/path_writer.h"
#include "tools/mdof/options.h"
#include "tools/mdof/output.h"
#include "tools/mdof/text/notice_lines.h"
#include "tools/mdof/text/text_table.h"

namespace mdof::tools {
namespace {

struct FormPathCommand {
  std::string map, out, centre;
  double speed_rpm = 0, feed_mm_min = 0, undulation_share = 0.01;
  std::optional<double> outer_radius_mm, bandwidth_hz, stroke_limit_um;
  double tool_radius_mm = 0, points_per_rev = 720, extend_pixels = 3;
  MapOptions maps;
  bool json = false;
};

struct FoundPath {
  algo::SpiralRequest request;
  algo::SpiralCounts counts;
  // NaN: the path has less than one turn.
  double undulations = 0;
  // Undulations of the surface that the points of the path do not show; 0: there are none.
  std::size_t hidden_undulations = 0;
  double frequency_hz = 0, stroke_m = 0, stroke_on_part_m = 0, acceleration_m_s2 = 0,
         duration_s = 0;
  std::optional<algo::MotionAboveBand> left_out;
  double overshoot_m = 0;   // of interpolated heights beside steps of the map
  double centre_off_m = 0;  // distance of the mean pixel from an assumed centre; 0: not notable
  std::size_t specks = 0;   // pixels that do not count for an assumed centre or outer radius
};

CLI::Validator whole_number_in(double least, double most) {
  const std::string range =
      "a whole number from " + plain_number(least) + " to " + plain_number(most, 9);
  return CLI::Validator(
      [=](const std::string& text) {
        const double x = std::strtod(text.c_str(), nullptr);
        return x >= least && x <= most && x == std::floor(x) ? std::string()
                                                             : text + " is not " + range;
      },
      "");
}

// The distance from the centre to the farthest measured pixel. Error: the map does not show that
// the part ends there.
Result<double> measured_radius_m(const SurfaceMap& map, double x_centre_m, double y_centre_m) {
  const algo::FarthestPixel pixel = algo::farthest_pixel(map, x_centre_m, y_centre_m);
  if (!algo::is_edge_missing(map)) return pixel.radius_m;
  const auto mm = [](double x_m) { return plain_number(to_mm(x_m), 7); };
  const double angle_deg =
      std::atan2(pixel.y_m - y_centre_m, pixel.x_m - x_centre_m) * 180 / std::numbers::pi;
  return bad_input(map.name +
                   ": the outermost rows and columns of the map are empty, so the outer radius of "
                   "the part is unknown (the farthest measured pixel is at radius " +
                   mm(pixel.radius_m) + " mm and angle " + plain_number(angle_deg) +
                   " degrees). Measure the part up to the edge, or give the start radius of the "
                   "path: --outer-radius-mm " +
                   mm(pixel.radius_m));
}

Result<algo::SpiralRequest> request_of(const FormPathCommand& o, const SurfaceMap& map) {
  algo::SpiralRequest request;
  if (!scanned_run_number(o.map)) {  // in a scan, the spindle axis is at (0, 0)
    const algo::MapMiddle middle = algo::middle_of(map);
    request.x_centre_m = middle.x_m;
    request.y_centre_m = middle.y_m;
  }
  if (!o.centre.empty()) {
    double x = 0, y = 0;
    char after = 0;
    std::string text = o.centre;
    const std::size_t comma = text.find(',');
    if (comma != std::string::npos) text[comma] = ' ';
    if (comma == std::string::npos ||
        std::sscanf(text.c_str(), "%lf %lf %c", &x, &y, &after) != 2 || !std::isfinite(x) ||
        !std::isfinite(y))
      return fail(ErrorCode::usage,
                  "--centre-mm \"" + o.centre + "\" must be two numbers, such as 0,-1.5");
    request.x_centre_m = from_mm(x);
    request.y_centre_m = from_mm(y);
  }
  if (o.outer_radius_mm) {
    request.outer_radius_m = from_mm(*o.outer_radius_mm);
  } else {
    MDOF_TRY(request.outer_radius_m,
             measured_radius_m(map, request.x_centre_m, request.y_centre_m));
  }
  request.feed_m = from_mm(o.feed_mm_min / o.speed_rpm);
  request.points_per_turn = static_cast<std::size_t>(o.points_per_rev);
  request.tool_radius_m = from_mm(o.tool_radius_mm);
  request.extend_pixels = static_cast<std::size_t>(o.extend_pixels);
  return request;
}

// A missing pixel at the edge moves the middle of the extreme pixels by up to half a pixel, but
// hardly moves the mean of all pixels.
constexpr double kPixelsOff = 0.1;

double centre_off_m(const SurfaceMap& map, const algo::SpiralRequest& request) {
  const algo::MapMiddle mean = algo::mean_pixel(map);
  const double off_m = std::hypot(mean.x_m - request.x_centre_m, mean.y_m - request.y_centre_m);
  return off_m > kPixelsOff * std::min(map.dx_m, map.dy_m) ? off_m : 0;
}

Status set_request(const FormPathCommand& o, const SurfaceMap& map, FoundPath& found) {
  const bool is_centre_known = !o.centre.empty() || scanned_run_number(o.map);
  const SurfaceMap part =
      is_centre_known && o.outer_radius_mm ? map : algo::without_specks(map, found.specks);
  MDOF_TRY(found.request, request_of(o, part));
  if (!is_centre_known) found.centre_off_m = centre_off_m(part, found.request);
  return {};
}

Result<FoundPath> write_path(const FormPathCommand& o, const SurfaceMap& map) {
  FoundPath found;
  MDOF_CHECK(set_request(o, map, found));
  MDOF_TRY(const algo::SpiralPath path, algo::SpiralPath::over(map, found.request));
  const double per_s = o.speed_rpm / 60;
  algo::TurnSpectrum spectrum = path.spectrum(o.bandwidth_hz ? *o.bandwidth_hz / per_s : -1);
  Motion motion, on_part;
  const PathRates rates{o.speed_rpm, found.request.points_per_turn};
  PathWriter writer(o.out, rates);
  MDOF_CHECK(writer.begin());
  MDOF_TRY(found.counts, path.each([&](const algo::PathPoint& point) {
    motion.add(point.z_m);
    if (point.on_part != algo::OnPart::bridged) on_part.add(point.z_m);
    spectrum.add(point.z_m);
    return writer.add(point);
  }));
  MDOF_CHECK(writer.finish());
  spectrum.finish();
  found.undulations = spectrum.turns() > 0
                          ? static_cast<double>(spectrum.undulations(o.undulation_share))
                          : std::nan("");
  if (const std::size_t finer =
          path.surface_undulations(std::min(map.dx_m, map.dy_m), o.undulation_share);
      2 * finer > found.request.points_per_turn) {
    found.hidden_undulations = finer;
    found.undulations = static_cast<double>(finer);
  }
  found.frequency_hz = found.undulations * per_s;
  found.stroke_m = motion.stroke_m();
  found.stroke_on_part_m = on_part.stroke_m();
  found.acceleration_m_s2 = motion.acceleration_m_s2(rates.t_s(1));
  found.duration_s = rates.t_s(found.counts.points - 1);
  if (o.bandwidth_hz && spectrum.turns() > 0 && found.hidden_undulations == 0)
    found.left_out = spectrum.left_out();
  if (spectrum.turns() == 0)
    warn(o.out + ": the path has less than one turn, so the undulations are unknown");
  found.overshoot_m = algo::overshoot_m(map, found.request.x_centre_m, found.request.y_centre_m,
                                        found.request.outer_radius_m);
  return found;
}

// The roughness that feed and tool radius cause; nullopt: the feed is so large that a ring between
// two turns remains uncut.
std::optional<algo::FeedRoughness> feed_roughness_if_closed(const FoundPath& found) {
  const algo::SpiralRequest& request = found.request;
  if (!(request.feed_m < 2 * request.tool_radius_m)) return {};
  return algo::feed_roughness(request.tool_radius_m, request.feed_m);
}

constexpr double kNotableOvershoot = 0.01;  // relative to the stroke on the part
// Limits for notices. If a part is long and narrow, the spiral is beside the part for most of each
// turn. There the path bridges a gap, and its stroke may be a little larger than on the part.
constexpr double kMostlyBridged = 0.9, kLargerBridgedStroke = 1.1;
constexpr double kLeastStroke_m = 1e-12;  // a smaller stroke is rounding

Notices notices_of(const FoundPath& found, const FormPathCommand& o) {
  const algo::SpiralRequest& request = found.request;
  const algo::SpiralCounts& counts = found.counts;
  Notices notices;
  if (found.centre_off_m > 0)
    notices.push_back(notice(NoticeCode::path_centre_assumed, o.map,
                             {{"x_mm", to_mm(request.x_centre_m)},
                              {"y_mm", to_mm(request.y_centre_m)},
                              {"off_um", to_um(found.centre_off_m)}}));
  if (found.specks > 0)
    notices.push_back(notice(NoticeCode::path_specks_ignored, o.map, {{"specks", found.specks}}));
  if (counts.too_sharp > 0)
    notices.push_back(
        notice(NoticeCode::path_tool_too_large, o.map, {{"points", counts.too_sharp}}));
  if (found.overshoot_m > kNotableOvershoot * found.stroke_on_part_m)
    notices.push_back(
        notice(NoticeCode::path_overshoots, o.map, {{"overshoot_um", to_um(found.overshoot_m)}}));
  if (found.hidden_undulations > 0)
    notices.push_back(notice(NoticeCode::path_hides_undulations, o.map,
                             {{"undulations", found.hidden_undulations},
                              {"points", request.points_per_turn},
                              {"needed", 4 * found.hidden_undulations}}));
  if (request.tool_radius_m > 0 && !feed_roughness_if_closed(found))
    notices.push_back(
        notice(NoticeCode::feed_leaves_rings, "",
               {{"feed_um", to_um(request.feed_m)}, {"radius_um", to_um(request.tool_radius_m)}}));
  if (static_cast<double>(counts.bridged) > kMostlyBridged * static_cast<double>(counts.points))
    notices.push_back(notice(NoticeCode::path_mostly_bridged, o.map,
                             {{"bridged", counts.bridged}, {"points", counts.points}}));
  else if (counts.extended > counts.measured)
    notices.push_back(notice(NoticeCode::path_mostly_unmeasured, o.map,
                             {{"measured", counts.measured}, {"points", counts.points}}));
  if (counts.bridged > 0 &&
      found.stroke_m > std::max(kLeastStroke_m, kLargerBridgedStroke * found.stroke_on_part_m))
    notices.push_back(notice(
        NoticeCode::path_stroke_bridged, o.map,
        {{"stroke_um", to_um(found.stroke_m)}, {"on_part_um", to_um(found.stroke_on_part_m)}}));
  return notices;
}

std::string path_json(const FoundPath& found, const FormPathCommand& o) {
  JsonWriter json;
  json.begin_object()
      .field("undulations", found.undulations)
      .field("frequency_hz", found.frequency_hz)
      .field("stroke_um", to_um(found.stroke_m))
      .field("points", static_cast<std::uint64_t>(found.counts.points))
      .key("left_by_bandwidth_um");
  if (found.left_out)
    json.begin_object()
        .field("pv", to_um(found.left_out->pv))
        .field("rms", to_um(found.left_out->rms))
        .end_object();
  else
    json.null();
  json.key("centre_mm")
      .begin_array()
      .value(to_mm(found.request.x_centre_m))
      .value(to_mm(found.request.y_centre_m))
      .end_array()
      .field("outer_radius_mm", to_mm(found.request.outer_radius_m))
      .field("feed_um_per_turn", to_um(found.request.feed_m))
      .field("turns", static_cast<double>(found.counts.points - 1) / o.points_per_rev)
      .field("duration_s", found.duration_s)
      .field("acceleration_max_m_s2", found.acceleration_m_s2)
      .key("points_by_part")
      .begin_object()
      .field("measured", static_cast<std::uint64_t>(found.counts.measured))
      .field("extended", static_cast<std::uint64_t>(found.counts.extended))
      .field("bridged", static_cast<std::uint64_t>(found.counts.bridged))
      .end_object();
  if (found.request.tool_radius_m > 0) {
    const auto rough = feed_roughness_if_closed(found);
    json.field("Ra_nm", rough ? rough->Ra_m * 1e9 : std::nan(""))
        .field("Rt_nm", rough ? rough->Rt_m * 1e9 : std::nan(""));
  }
  json.field("overshoot_um", to_um(found.overshoot_m))
      .field("hidden_undulations", static_cast<std::uint64_t>(found.hidden_undulations))
      .field("points_too_sharp", static_cast<std::uint64_t>(found.counts.too_sharp));
  write_notices(json, "notices", notices_of(found, o), words::text);
  json.field("out", o.out).end_object();
  return json.take();
}

std::string path_text(const FoundPath& found, const FormPathCommand& o) {
  const auto mm = [](double x_m) { return plain_number(to_mm(x_m), 7); };
  std::string text = o.out + ": " + std::to_string(found.counts.points) + " points from radius " +
                     mm(found.request.outer_radius_m) +
                     " mm inwards, centre x = " + mm(found.request.x_centre_m) +
                     " mm, y = " + mm(found.request.y_centre_m) + " mm; duration " +
                     plain_number(found.duration_s / 60) + " min\n" +
                     "points: on measured pixels " + std::to_string(found.counts.measured) +
                     ", extended beyond the edge " + std::to_string(found.counts.extended) +
                     ", bridged over gaps " + std::to_string(found.counts.bridged) + "\n";
  text += (std::isnan(found.undulations)
               ? "undulations unknown"
               : plain_number(found.undulations, 9) + " undulations per turn, " +
                     plain_number(found.frequency_hz) + " Hz") +
          "; stroke " + in_um(found.stroke_m) + " µm; acceleration up to " +
          plain_number(found.acceleration_m_s2) + " m/s²\n";
  if (found.left_out)
    text += "a low-pass filter of " + plain_number(*o.bandwidth_hz) +
            " Hz removes from the path: PV " + in_um(found.left_out->pv) + " µm, RMS " +
            in_um(found.left_out->rms) + " µm\n";
  if (const auto rough = feed_roughness_if_closed(found))
    text += "theoretical roughness from feed and tool radius: Ra " +
            plain_number(rough->Ra_m * 1e9) + " nm, Rt " + plain_number(rough->Rt_m * 1e9) +
            " nm\n";
  return text;
}

Status form_path(const FormPathCommand& o) {
  MDOF_CHECK(check_out(o.out, {o.map}));
  MDOF_TRY(const SurfaceMap map, load_map(o.map, o.maps));
  MDOF_TRY(const FoundPath found, write_path(o, map));
  show_notices(notices_of(found, o), true);
  MDOF_CHECK(o.json ? write_line(path_json(found, o)) : write_out(path_text(found, o)));
  if (o.bandwidth_hz && std::isnan(found.frequency_hz))
    return fail(ErrorCode::check,
                o.map +
                    ": the path has less than one turn, so its frequency is unknown and cannot "
                    "be compared with --bandwidth-hz; reduce --feed-mm-min");
  if (o.bandwidth_hz && found.frequency_hz > *o.bandwidth_hz)
    return fail(ErrorCode::check, o.map + ": the path needs a servo bandwidth of " +
                                      plain_number(found.frequency_hz) +
                                      " Hz, above --bandwidth-hz " + plain_number(*o.bandwidth_hz) +
                                      "; reduce --speed-rpm");
  if (o.stroke_limit_um && to_um(found.stroke_m) > *o.stroke_limit_um)
    return fail(ErrorCode::check,
                o.map + ": the path needs a stroke of " + plain_number(to_um(found.stroke_m)) +
                    " µm, above --stroke-limit-um " + plain_number(*o.stroke_limit_um));
  return {};
}

Action declare_form_path(CLI::App& command) {
  const auto o = std::make_shared<FormPathCommand>();
  command.add_option("MAP", o->map, "Height map of the surface to cut")->required()->type_name("");
  command.add_option("--speed-rpm", o->speed_rpm, "Speed of the spindle")
      ->required()
      ->check(positive_number());
  command.add_option("--feed-mm-min", o->feed_mm_min, "Feed towards the centre")
      ->required()
      ->check(positive_number());
  command
      .add_option("--out", o->out,
                  "Write the tool path to this file: CSV with the columns "
                  "t_s,rho_mm,theta_deg,z_um,on_part (1: measured, 2: extended beyond the edge, 0: "
                  "bridged over a gap), or "
                  "G-code if the file name ends in .ngc, .nc, .gcode or .tap. theta and C are "
                  "angles on the part from +X towards +Y: seen from +z, the part turns clockwise "
                  "under the tool")
      ->required()
      ->type_name("FILE");
  command
      .add_option("--centre-mm", o->centre,
                  "Position of the spindle axis [default: middle of the measured pixels; for the "
                  "scan of a run: 0,0]")
      ->type_name("X,Y");
  command
      .add_option(
          "--outer-radius-mm", o->outer_radius_mm,
          "Radius at which the path begins [default: radius of the farthest measured pixel]; "
          "required if all pixels at the edges of the map are empty")
      ->check(positive_number());
  command.add_option("--points-per-rev", o->points_per_rev, "Points per turn")
      ->type_name("N")
      ->check(whole_number_in(4, 1'000'000))
      ->capture_default_str();
  command.add_option("--tool-radius-mm", o->tool_radius_mm, "Radius of the tool; 0: pointed tool")
      ->check(not_negative_number())
      ->capture_default_str();
  command
      .add_option("--extend-pixels", o->extend_pixels,
                  "Number of pixels by which mdof extends the surface beyond the edge")
      ->type_name("N")
      ->check(whole_number_in(0, 100))
      ->capture_default_str();
  command
      .add_option("--undulation-share", o->undulation_share,
                  "Share of the largest amplitude; undulations with a smaller amplitude do not "
                  "count for the bandwidth")
      ->check(number_in(1e-9, 1))
      ->capture_default_str();
  command
      .add_option("--bandwidth-hz", o->bandwidth_hz,
                  "Bandwidth of the servo; exit code 1 if the path needs a larger bandwidth")
      ->check(positive_number());
  command
      .add_option("--stroke-limit-um", o->stroke_limit_um,
                  "Largest stroke of the servo; exit code 1 if the path needs a larger stroke")
      ->check(positive_number());
  add_map_options(command, o->maps);
  add_json_flag(command, o->json);
  return [o] { return form_path(*o); };
}

}  // namespace

Command form_path_command() {
  return {.name = "form path",
          .summary = "Calculate the path of a fast tool servo over a height map",
          .footer =
              "Example:\n"
              "  mdof form path elastic.csv --speed-rpm 300 --feed-mm-min 1.2 --tool-radius-mm 0.2 "
              "--bandwidth-hz 500 --out path.csv",
          .declare = declare_form_path};
}

}  // namespace mdof::tools
