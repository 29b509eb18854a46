#include "tools/mdof/commands/separate/separation_sources.h"

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cmath>

#include "algo/separation/run_series.h"
#include "algo/sequence/usable_runs.h"
#include "daemon/measure/evaluation.h"
#include "drivers/csv/csv_table.h"
#include "schema/base/files.h"
#include "schema/base/number/number_text.h"
#include "schema/base/sha256.h"
#include "schema/units.h"
#include "tools/mdof/options.h"
#include "tools/mdof/stored/database.h"
#include "tools/mdof/stored/run_choice.h"

namespace mdof::tools {
namespace {

constexpr std::size_t kMostBytes = std::size_t{64} << 20;

Surface surface_of(const SourceOptions& options) {
  return options.surface == "top" ? Surface::top : Surface::side;
}

LoadedSources nothing_yet(const SourceOptions& options, const MovingAxis& moving) {
  LoadedSources loaded;
  const algo::AcrossSurface across = algo::across(moving.axis, surface_of(options));
  loaded.request.at.sides = moving.sides;
  loaded.request.match_m = from_mm(options.match_mm);
  loaded.record.surface = surface_of(options);
  loaded.record.axis = moving.axis;
  loaded.record.normal = across.normal;
  loaded.record.sides = moving.sides;
  loaded.record.error = error_names(moving.axis)[across.named].name;
  return loaded;
}

Status check_numbers(const SourceOptions& options) {
  if (!(options.match_mm > 0 && options.match_mm <= 1))
    return fail(ErrorCode::usage, "--match-mm must be above 0 and at most 1");
  if (!std::isfinite(options.at_mm))
    return fail(ErrorCode::usage, "--at-mm must be a finite number");
  if (options.u_um && !(*options.u_um > 0 && std::isfinite(*options.u_um)))
    return fail(ErrorCode::usage, "--u-um must be a finite number above 0");
  return {};
}

// ---- files ----

Status add_file(const SourceOptions& options, const std::string& file, LoadedSources& loaded) {
  if (file == "-")
    return fail(ErrorCode::usage,
                "a set-up must be a run or a file, not standard input; write the data to a file");
  MDOF_TRY(const auto csv,
           drivers::read_csv_table(file, {"position_mm", "deviation_um"}, {"u_um"}));
  MDOF_TRY(const std::string bytes, read_text_file(file, kMostBytes));
  SeparationSource source{file, sha256_hex(bytes)};
  for (const SeparationSource& before : loaded.record.sources)
    if (before.sha256 == source.sha256)
      return bad_input(file + ": this file is identical to " + before.name +
                       "; give each set-up its own file");
  algo::SetUp set_up;
  for (const double x : csv.columns[0]) set_up.position_m.push_back(from_mm(x));
  for (const double x : csv.columns[1]) set_up.error_m.push_back(from_um(x));
  for (const double u : csv.columns[2]) set_up.u_m.push_back(from_um(u));
  if (set_up.u_m.empty() && options.u_um)
    set_up.u_m.assign(set_up.position_m.size(), from_um(*options.u_um));
  loaded.request.set_ups.push_back(std::move(set_up));
  loaded.record.sources.push_back(std::move(source));
  loaded.record.simulated = loaded.record.simulated || csv.simulated;
  return {};
}

Result<LoadedSources> load_files(const SourceOptions& options) {
  if (!options.probe.empty())
    return fail(ErrorCode::usage,
                "--probe applies to runs only, because a file has one series; leave out --probe");
  if (options.moves.empty())
    return fail(
        ErrorCode::usage,
        "missing option --moves: the sign of the target height depends on the body that the axis "
        "moves, and a file does not state this body; give --moves target or --moves fixture");
  const Sides sides{options.moves == "fixture", options.travel == "-"};
  LoadedSources loaded = nothing_yet(options, {*axis_from(options.axis), sides});
  loaded.request.at.place_m = from_mm(options.at_mm);
  for (const std::string& file : options.sources) MDOF_CHECK(add_file(options, file, loaded));
  return loaded;
}

// ---- runs ----

Status check_alike(const Run& first, const Run& run) {
  if (first.header.axis == run.header.axis && first.header.sides == run.header.sides) return {};
  return bad_input("runs " + std::to_string(first.header.id) + " and " +
                   std::to_string(run.header.id) +
                   " have different axes, or the rigs of these runs differ in the keys \"moves\" "
                   "or \"travel\"; give runs of one axis of one machine");
}

Status check_without_map(const Run& run, const Rig& rig) {
  for (const TargetPlane& plane : rig.planes)
    if (!plane.flatness.empty())
      return bad_input(
          "run " + std::to_string(run.header.id) +
          ": the rig of this run already subtracts the height map of plane \"" + plane.id +
          "\", so the run no longer contains the shape of the target; replay the log of the run "
          "with a rig without flatness_um, or use the readings of one probe with --probe");
  return {};
}

std::string at_text(const Vec3& p) {
  return "[" + plain_number(to_mm(p[0])) + ", " + plain_number(to_mm(p[1])) + ", " +
         plain_number(to_mm(p[2])) + "] mm";
}

// Error: the positions of the probe along the axis differ between the runs. Adds a notice if its
// positions perpendicular to the axis differ, because this causes an Abbe offset.
Status check_places(const std::vector<Vec3>& at, const SourceOptions& options,
                    LoadedSources& loaded) {
  const double match_m = from_mm(options.match_mm);
  for (std::size_t k = 1; k < at.size(); ++k)
    for (std::size_t i = 0; i < 3; ++i) {
      if (i == static_cast<std::size_t>(loaded.record.normal) ||
          std::abs(at[k][i] - at[0][i]) <= match_m)
        continue;
      const std::string differ = "probe \"" + options.probe + "\" is at " + at_text(at[0]) +
                                 " in " + loaded.record.sources[0].name + " and at " +
                                 at_text(at[k]) + " in " + loaded.record.sources[k].name;
      if (i == static_cast<std::size_t>(loaded.record.axis))
        return bad_input(differ + "; give set-ups in which the probe has the same position along " +
                         letter(loaded.record.axis) +
                         ", because the probe otherwise measures another position on the target");
      loaded.notices.push_back(notice(NoticeCode::places_differ, "", {{"difference", differ}}));
    }
  return {};
}

Status add_run(store::Store& store, const Run& run, const SourceOptions& options,
               LoadedSources& loaded, std::vector<Vec3>& probe_at) {
  MDOF_TRY(const Rig rig, daemon::rig_of(run.header));
  MDOF_TRY(const std::string sha256, store.result_sha256(run.header.id));
  algo::SetUp set_up;
  if (options.probe.empty()) {
    MDOF_CHECK(check_without_map(run, rig));
    const auto across = algo::across(run.header.axis, loaded.record.surface);
    set_up = algo::error_series(run, across.named);
    MDOF_TRY(set_up.declared, algo::declared_shifts(run, rig, across.named, across.normal));
  } else {
    MDOF_TRY(algo::ProbeSeries series,
             algo::probe_series(run, rig, options.probe, loaded.record.normal));
    probe_at.push_back(series.position_m);
    set_up = std::move(series.set_up);
  }
  loaded.probes.push_back(algo::probes_across(rig, loaded.record.normal, options.probe));
  loaded.request.set_ups.push_back(std::move(set_up));
  loaded.record.sources.push_back({"run " + std::to_string(run.header.id), sha256});
  loaded.record.simulated = loaded.record.simulated || run.header.simulated;
  return {};
}

Result<std::vector<Run>> runs_of(store::Store& store, const SourceOptions& options) {
  std::vector<Run> runs;
  for (const std::string& word : options.sources) {
    MDOF_TRY(const auto id,
             run_number(store, word, options.axis_given ? axis_from(options.axis) : std::nullopt));
    MDOF_TRY(Run run, daemon::restated_run(store, id, Reference::fixture));
    runs.push_back(std::move(run));
    MDOF_CHECK(check_alike(runs.front(), runs.back()));
  }
  MDOF_CHECK(algo::check_usable(algo::all_of(runs), options.partial, "a separation"));
  return runs;
}

Result<LoadedSources> load_runs(const SourceOptions& options) {
  if (options.sides_given)
    return fail(ErrorCode::usage,
                "--moves, --travel, --at-mm and --u-um apply to files only; leave out these "
                "options, because mdof takes these values from the rig of the run");
  MDOF_TRY(store::Store store, open_to_read(options.database));
  MDOF_TRY(const auto runs, runs_of(store, options));
  LoadedSources loaded = nothing_yet(options, runs.front().header.moving());
  loaded.request.u_is_noise = true;
  std::vector<Vec3> probe_at;
  for (const Run& run : runs) MDOF_CHECK(add_run(store, run, options, loaded, probe_at));
  loaded.notices = algo::inherited_notices(algo::all_of(runs));
  loaded.record.probe = options.probe;
  if (!probe_at.empty()) {
    loaded.request.at.place_m = probe_at[0][static_cast<std::size_t>(loaded.record.axis)];
    MDOF_CHECK(check_places(probe_at, options, loaded));
  } else {
    loaded.notices.push_back(
        notice(NoticeCode::made_of_several_probes, "", {{"error", loaded.record.error}}));
  }
  return loaded;
}

}  // namespace

void add_source_options(CLI::App& command, SourceOptions& o) {
  command
      .add_option(
          "--surface", o.surface,
          "Measured surface of the target: \"side\" (its form is measured in the direction y of "
          "the local frame of the axis) or \"top\" (in the direction z)")
      ->required()
      ->check(CLI::IsMember({"side", "top"}));
  command
      .add_option(
          "--turned-about", o.turned_about,
          "Machine axis about which the target was turned by 180° [default: the moving axis]")
      ->check(CLI::IsMember({"X", "Y", "Z"}));
  command.add_option("--probe", o.probe, "For runs: use only the readings of this probe")
      ->type_name("ID");
  command
      .add_option("--axis", o.axis,
                  "For files: the moving axis [default: X]; for \"latest\": axis of the run")
      ->check(CLI::IsMember({"X", "Y", "Z"}))
      ->each([&o](const std::string&) { o.axis_given = true; });
  const auto of_files = [&o](CLI::Option* option) {
    return option->each([&o](const std::string&) { o.sides_given = true; });
  };
  of_files(command.add_option("--moves", o.moves,
                              "For files: body that the axis moves, the target or the fixture"))
      ->check(CLI::IsMember({"target", "fixture"}));
  of_files(command.add_option(
               "--travel", o.travel,
               "For files: direction in which the target or fixture moves when the position "
               "increases (+ or -)"))
      ->check(CLI::IsMember({"+", "-"}))
      ->capture_default_str();
  of_files(
      command.add_option("--at-mm", o.at_mm, "For files: position of the indicator along the axis"))
      ->capture_default_str();
  of_files(command.add_option(
      "--u-um", o.u_um, "For files without the column u_um: standard uncertainty of each reading"));
  command
      .add_option("--match-mm", o.match_mm,
                  "Positions that differ by this length or less count as the same position")
      ->capture_default_str();
  command.add_flag("--partial", o.partial, "Also accept partial runs");
  add_database_option(command, o.database);
}

Result<LoadedSources> load_sources(const SourceOptions& options) {
  MDOF_CHECK(check_numbers(options));
  const auto is_run = [](const std::string& word) { return run_argument_error(word).empty(); };
  const auto runs = std::count_if(options.sources.begin(), options.sources.end(), is_run);
  if (runs == 0) return load_files(options);
  if (runs == static_cast<std::ptrdiff_t>(options.sources.size())) return load_runs(options);
  return fail(ErrorCode::usage,
              "files and runs cannot be mixed; give runs only, or files only (if the name of a "
              "file is a number, write ./7)");
}

Axis turned_about(const SourceOptions& options, Axis motion) {
  return axis_from(options.turned_about).value_or(motion);
}

}  // namespace mdof::tools
