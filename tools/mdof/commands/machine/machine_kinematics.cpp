// mdof machine kinematics --preset co-planar: calculates the effect of the resolution and the
// errors of the screws of a tilt drive, and converts motions between the platform and the screws.
#include <CLI/CLI.hpp>
#include <array>
#include <charconv>
#include <cmath>
#include <optional>

#include "algo/machine/tilt_drive.h"
#include "schema/base/json_writer.h"
#include "schema/base/number/number_text.h"
#include "schema/units.h"
#include "tools/mdof/commands/command.h"
#include "tools/mdof/options.h"
#include "tools/mdof/output.h"
#include "tools/mdof/terminal.h"
#include "tools/mdof/text/text_table.h"

namespace mdof::tools {
namespace {

constexpr double kRadPerDeg = 3.14159265358979323846 / 180;
constexpr std::array<double, 4> kTurns_deg = {0, 15, 30, 45};
constexpr std::array<double, 4> kTravel = {60e-3, 40e-3, 40e-3, 45 * kRadPerDeg};  // from the paper

struct KinematicsCommand {
  std::string preset = "co-planar", platform, screws, velocity, acceleration;
  double tilt_deg = 25.84, screw_error_um = 0.5, screw_resolution_nm = 1000, arm_mm = 17;
  double tilt_error_deg = 0.05;
  bool json = false;
};

// The platform side or the screw side of the drive: letters of its coordinates, in the order of the
// arrays, and whether the last coordinate is an angle.
struct Side {
  const char* option;
  const char* letters;
  bool last_turns;

  double unit(std::size_t i) const { return last_turns && i == 3 ? kRadPerDeg : 1e-3; }
  std::string key(std::size_t i) const {
    return std::string(1, letters[i]) + (!last_turns ? "" : i == 3 ? "_deg" : "_mm");
  }
};
constexpr Side kPlatform{"--platform", "XYZB", true}, kScrews{"--screws", "ABCD", false};
using Four = std::array<double, 4>;

Result<Four> values(const Side& side, const std::string& option, const std::string& text) {
  Four values{};
  if (text.empty()) return values;
  std::string seen;
  for (const std::string& word : CLI::detail::split(text, ',')) {
    const std::size_t i = std::string_view(side.letters).find(word.substr(0, 1));
    double x = 0;
    const char* end = word.data() + word.size();
    const bool assigned = word.size() > 2 && word[1] == '=' && i != std::string_view::npos;
    const auto [last, error] =
        assigned ? std::from_chars(word.data() + 2, end, x) : std::from_chars_result{end, {}};
    if (!assigned || error != std::errc() || last != end || !std::isfinite(x))
      return fail(ErrorCode::usage, option + ": \"" + word + "\" is not a value; write " +
                                        side.letters[0] + "=1,…," + side.letters[3] + "=2" +
                                        (side.last_turns ? " (mm, B in degrees)" : " (mm)"));
    if (seen.find(word[0]) != std::string::npos)
      return fail(ErrorCode::usage,
                  option + ": " + word[0] + " is given twice; give only one value");
    seen += word[0];
    values[i] = x * side.unit(i);
  }
  return values;
}

using FourMotions = std::array<algo::Motion, 4>;

Result<FourMotions> motions(const Side& side, const KinematicsCommand& o,
                            const std::string& position) {
  MDOF_TRY(const Four at, values(side, side.option, position));
  MDOF_TRY(const Four velocity, values(side, "--velocity", o.velocity));
  MDOF_TRY(const Four acceleration, values(side, "--acceleration", o.acceleration));
  FourMotions motions;
  for (std::size_t i = 0; i < 4; ++i) motions[i] = {at[i], velocity[i], acceleration[i]};
  return motions;
}

struct Found {
  double platform_error_x_um, platform_error_y_um, platform_resolution_nm, spindle_resolution_nm;
  double tilt_error_x_um, tilt_error_y_um;
  Four rotation_resolution_deg{};
  algo::ScrewMotion travel{};         // motion of the screws for the motion kTravel of the platform
  std::optional<FourMotions> motion;  // calculated, for the side that the user did not give
  const Side* side = nullptr;         // the side whose motion is in `motion`
};

Status check_options(const KinematicsCommand& o) {
  const auto refuse = [](const char* option, const std::string& limits) {
    return fail(ErrorCode::usage, std::string(option) + " must be " + limits);
  };
  if (!(o.tilt_deg > 0 && o.tilt_deg < 90))
    return refuse("--tilt-deg", "above 0 and below 90 degrees");
  if (!(o.arm_mm > 0 && o.arm_mm < 1e6)) return refuse("--arm-mm", "above 0 and below 1000000 mm");
  if (!(o.screw_resolution_nm > 0 && o.screw_resolution_nm < 1e9))
    return refuse("--screw-resolution-nm", "above 0 and below 1000000000 nm");
  if (!std::isfinite(o.screw_error_um)) return refuse("--screw-error-um", "a finite number");
  if (!(std::abs(o.tilt_error_deg) < 5))
    return refuse("--tilt-error-deg", "between -5 and 5 degrees");
  if (!o.platform.empty() && !o.screws.empty())
    return fail(ErrorCode::usage, "give either --platform or --screws, not both");
  if (o.platform.empty() && o.screws.empty() && !(o.velocity.empty() && o.acceleration.empty()))
    return fail(ErrorCode::usage, "--velocity and --acceleration need --platform or --screws");
  return {};
}

Result<Found> find(const KinematicsCommand& o) {
  MDOF_CHECK(check_options(o));
  const algo::CoPlanarDrive drive{o.tilt_deg * kRadPerDeg, from_mm(o.arm_mm)};
  const double tilt_error = o.tilt_error_deg * kRadPerDeg;
  Found f{};
  f.platform_error_x_um = o.screw_error_um * algo::platform_ratio(drive);
  f.platform_error_y_um = o.screw_error_um * algo::spindle_ratio(drive);
  f.platform_resolution_nm = o.screw_resolution_nm * algo::platform_ratio(drive);
  f.spindle_resolution_nm = o.screw_resolution_nm * algo::spindle_ratio(drive);
  f.tilt_error_x_um = to_um(algo::platform_tilt_effect(drive, kTravel[0], tilt_error));
  f.tilt_error_y_um = to_um(algo::spindle_tilt_effect(drive, kTravel[1], tilt_error));
  for (std::size_t i = 0; i < kTurns_deg.size(); ++i) {
    auto step =
        algo::rotation_step(drive, kTurns_deg[i] * kRadPerDeg, o.screw_resolution_nm * 1e-9);
    if (!step) return in_context("--arm-mm", std::move(step.error()));
    f.rotation_resolution_deg[i] = *step / kRadPerDeg;
  }
  for (std::size_t i = 0; i < 4; ++i) {  // moves one axis at a time; the rotation B uses screw A
    FourMotions platform{};
    platform[i].position = kTravel[i];
    MDOF_TRY(const auto screws, algo::screws_for(drive, platform));
    constexpr std::array<std::size_t, 4> moves = {algo::kScrewB, algo::kScrewD, algo::kScrewA,
                                                  algo::kScrewA};
    f.travel[i] = screws[moves[i]];
  }
  if (!o.platform.empty()) {
    MDOF_TRY(const auto platform, motions(kPlatform, o, o.platform));
    auto screws = algo::screws_for(drive, platform);
    if (!screws) return in_context(kPlatform.option, std::move(screws.error()));
    f.motion = *screws;
    f.side = &kScrews;
  } else if (!o.screws.empty()) {
    MDOF_TRY(const auto screws, motions(kScrews, o, o.screws));
    auto platform = algo::platform_for(drive, screws);
    if (!platform) return in_context(kScrews.option, std::move(platform.error()));
    f.motion = *platform;
    f.side = &kPlatform;
  }
  return f;
}

void write_motion(JsonWriter& json, const Side& side, const std::string& key,
                  const FourMotions& motions, double algo::Motion::*member) {
  json.key(key).begin_object();
  for (std::size_t i = 0; i < 4; ++i) json.field(side.key(i), motions[i].*member / side.unit(i));
  json.end_object();
}

std::string kinematics_json(const KinematicsCommand& o, const Found& f) {
  JsonWriter json;
  json.begin_object()
      .field("preset", o.preset)
      .field("tilt_deg", o.tilt_deg)
      .field("arm_mm", o.arm_mm)
      .field("screw_error_um", o.screw_error_um)
      .field("screw_resolution_nm", o.screw_resolution_nm)
      .field("platform_error_x_um", f.platform_error_x_um)
      .field("platform_error_y_um", f.platform_error_y_um)
      .field("platform_resolution_nm", f.platform_resolution_nm)
      .field("spindle_resolution_nm", f.spindle_resolution_nm);
  json.key("rotation_resolution_deg").begin_object();
  for (std::size_t i = 0; i < kTurns_deg.size(); ++i)
    json.field(plain_number(kTurns_deg[i]), f.rotation_resolution_deg[i]);
  json.end_object();
  json.field("tilt_error_deg", o.tilt_error_deg);
  write_motion(json, kPlatform, "travel",
               {{{kTravel[0]}, {kTravel[1]}, {kTravel[2]}, {kTravel[3]}}}, &algo::Motion::position);
  json.field("tilt_error_x_um", f.tilt_error_x_um).field("tilt_error_y_um", f.tilt_error_y_um);
  json.key("screw_travel_mm").begin_object();
  for (std::size_t i = 0; i < 4; ++i)
    json.field(std::string(1, kPlatform.letters[i]), to_mm(f.travel[i].position));
  json.end_object();
  if (f.motion) {
    const bool screws = f.side == &kScrews;
    const std::string name = screws ? "screws" : "platform", unit = screws ? "_mm" : "";
    write_motion(json, *f.side, name + unit, *f.motion, &algo::Motion::position);
    if (!o.velocity.empty() || !o.acceleration.empty()) {
      write_motion(json, *f.side, name + "_velocity" + (screws ? "_mm_per_s" : "_per_s"), *f.motion,
                   &algo::Motion::velocity);
      write_motion(json, *f.side, name + "_acceleration" + (screws ? "_mm_per_s2" : "_per_s2"),
                   *f.motion, &algo::Motion::acceleration);
    }
  }
  json.end_object();
  return json.take();
}

std::string motion_text(const KinematicsCommand& o, const Found& f) {
  if (!f.motion) return "";
  const bool moves = !o.velocity.empty() || !o.acceleration.empty();
  TextTable table({f.side == &kScrews ? "screw" : "axis", "position", "velocity", "acceleration"});
  for (std::size_t i = 0; i < 4; ++i) {
    const algo::Motion& m = (*f.motion)[i];
    const double unit = f.side->unit(i);
    table.add({std::string(1, f.side->letters[i]), fixed(m.position / unit, 6),
               moves ? fixed(m.velocity / unit, 6) : "",
               moves ? fixed(m.acceleration / unit, 6) : ""});
  }
  return "\n" + table.text(terminal_columns()) + "values in mm, mm/s and mm/s²" +
         (f.side == &kPlatform ? "; values of B in degrees, degrees/s and degrees/s²\n" : "\n");
}

std::string kinematics_text(const KinematicsCommand& o, const Found& f) {
  TextTable ratios({"one screw", "at the platform (X, Z)", "at the spindle seat (Y)"});
  ratios.add({"step " + plain_number(o.screw_resolution_nm, 6) + " nm",
              fixed(f.platform_resolution_nm, 1) + " nm",
              fixed(f.spindle_resolution_nm, 1) + " nm"});
  ratios.add({"error " + plain_number(o.screw_error_um, 6) + " µm",
              fixed(f.platform_error_x_um, 4) + " µm", fixed(f.platform_error_y_um, 4) + " µm"});
  ratios.add({"tilt error " + plain_number(o.tilt_error_deg, 6) + "° over the travel",
              fixed(f.tilt_error_x_um, 1) + " µm", fixed(f.tilt_error_y_um, 1) + " µm"});
  TextTable travels({"axis", "travel", "screw travel/mm"});
  for (std::size_t i = 0; i < 4; ++i)
    travels.add({std::string(1, kPlatform.letters[i]),
                 plain_number(kTravel[i] / kPlatform.unit(i)) + (i == 3 ? "°" : " mm"),
                 fixed(to_mm(f.travel[i].position), 2)});
  std::string turns = "one screw step turns the platform by";
  for (std::size_t i = 0; i < kTurns_deg.size(); ++i)
    turns += (i == 0 ? " " : ", ") + fixed(f.rotation_resolution_deg[i], 5) +
             "° at B = " + plain_number(kTurns_deg[i]) + "°";
  return "co-planar tilt drive, tilt " + plain_number(o.tilt_deg, 6) + "°, arm " +
         plain_number(o.arm_mm, 6) + " mm\n" + ratios.text(terminal_columns()) + "\n" +
         travels.text(terminal_columns()) + "\n" + wrapped(turns, terminal_columns()) + "\n" +
         motion_text(o, f);
}

Status machine_kinematics(const KinematicsCommand& o) {
  MDOF_TRY(const Found found, find(o));
  return o.json ? write_line(kinematics_json(o, found)) : write_out(kinematics_text(o, found));
}

Action declare_machine_kinematics(CLI::App& command) {
  const auto o = std::make_shared<KinematicsCommand>();
  const auto number = [&](const char* name, double& value, const char* help) {
    command.add_option(name, value, help)->check(finite_number())->capture_default_str();
  };
  command.add_option("--preset", o->preset, "Machine with the tilt drive")
      ->check(CLI::IsMember({"co-planar"}))
      ->capture_default_str();
  number("--tilt-deg", o->tilt_deg, "Angle between a screw and the sliding rod of this screw");
  number("--arm-mm", o->arm_mm,
         "Distance from the centre of the platform to the rods that turn the platform");
  number("--screw-resolution-nm", o->screw_resolution_nm, "Length of one step of a screw");
  number("--screw-error-um", o->screw_error_um, "Axial error of a screw");
  number("--tilt-error-deg", o->tilt_error_deg, "Error of the tilt angle");
  const auto values = [&](const char* name, std::string& value, const char* help) {
    command.add_option(name, value, help)->type_name("");
  };
  values(
      "--platform", o->platform,
      "Position of the platform, X=…,Y=…,Z=…,B=… (mm, degrees); mdof prints the screw positions");
  values("--screws", o->screws,
         "Positions of the screws, A=…,B=…,C=…,D=… (mm); mdof prints the position of the platform");
  values("--velocity", o->velocity,
         "Velocity of the platform (with --platform) or of the screws (with --screws), in mm/s and "
         "degrees/s");
  values("--acceleration", o->acceleration,
         "Acceleration of the platform (with --platform) or of the screws (with --screws), in "
         "mm/s² and degrees/s²");
  add_json_flag(command, o->json);
  return [o] { return machine_kinematics(*o); };
}

}  // namespace

Command machine_kinematics_command() {
  return {.name = "machine kinematics",
          .summary =
              "Calculate resolution, errors and motion of a co-planar tilt drive from its screws",
          .footer =
              "Axes and screws that are not given with --platform or --screws are at 0.\n"
              "Examples:\n"
              "  mdof machine kinematics --preset co-planar --tilt-deg 25.84\n"
              "  mdof machine kinematics --platform X=10,Y=5,Z=-10,B=30 --velocity B=10",
          .declare = declare_machine_kinematics};
}

}  // namespace mdof::tools
