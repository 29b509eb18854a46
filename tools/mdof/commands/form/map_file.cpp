#include "tools/mdof/commands/form/map_file.h"

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cmath>
#include <filesystem>
#include <optional>
#include <utility>

#include "algo/form/clamping.h"
#include "daemon/output/charts/form/height_map_chart.h"
#include "daemon/output/charts/plot_files.h"
#include "schema/base/files.h"
#include "schema/base/output/output_files.h"
#include "schema/form/map_text.h"
#include "schema/form/surface_files.h"
#include "schema/units.h"
#include "tools/mdof/options.h"
#include "tools/mdof/output.h"
#include "tools/mdof/stored/database.h"
#include "tools/mdof/text/notice_lines.h"

namespace mdof::tools {
namespace {

constexpr std::size_t kMostBytes = std::size_t{2}
                                   << 30;  // largest size of a file that is read as a whole

std::string_view without_byte_order_mark(std::string_view piece) {
  constexpr std::string_view kMark = "\xef\xbb\xbf";
  return piece.starts_with(kMark) ? piece.substr(kMark.size()) : piece;
}

// Reads a map in pieces. The first piece shows the format of the file. A text file is converted
// piece by piece, so that a large map is not in memory as text.
class MapReader {
 public:
  MapReader(std::string file, std::optional<XyzUnits> units)
      : file_(std::move(file)), text_(file_, units) {
    std::error_code unknown;
    const auto bytes = std::filesystem::file_size(file_, unknown);
    if (!unknown) text_.expect_bytes(bytes);
  }

  Status take(std::string_view piece) {
    if (!is_reported_) {
      is_reported_ = true;
      if (is_sdf(without_byte_order_mark(piece))) piece = without_byte_order_mark(piece);
      is_complete_ = is_sdf(piece) || is_zygo_dat(piece);
      if (piece.starts_with("PK\x03\x04"))
        return bad_input(file_ +
                         ": the file is an archive, such as .x3p; export the map as .sdf or as "
                         "text with x, y, z");
    }
    if (!is_complete_) return text_.feed(piece);
    if (whole_.size() + piece.size() > kMostBytes)
      return bad_input(file_ +
                       ": the file is larger than 2 GiB, the limit for a height map; check the "
                       "name of the file");
    whole_.append(piece);
    return {};
  }
  bool states_units() const { return is_complete_ || text_.has_header(); }
  Result<SurfaceMap> map() {
    if (!is_complete_) return text_.finish();
    return is_sdf(whole_) ? parse_sdf(whole_, file_) : parse_zygo_dat(whole_, file_);
  }

 private:
  std::string file_, whole_;
  MapTextReader text_;
  bool is_reported_ = false, is_complete_ = false;
};

}  // namespace

std::optional<std::int64_t> scanned_run_number(const std::string& name) {
  constexpr std::string_view kRun = "run:";
  const bool says_run = name.starts_with(kRun);
  const std::string digits = says_run ? name.substr(kRun.size()) : name;
  const bool is_number = !digits.empty() && digits.size() <= 18 &&
                         digits.find_first_not_of("0123456789") == digits.npos;
  if (!is_number || (!says_run && std::filesystem::exists(name))) return std::nullopt;
  return std::stoll(digits);
}

Status check_out(const std::string& out, const std::vector<std::string>& maps) {
  std::error_code unknown;  // ignored: the file does not exist yet
  for (const std::string& map : maps)
    if (!out.empty() && !scanned_run_number(map) && std::filesystem::equivalent(out, map, unknown))
      return fail(ErrorCode::usage, "--out " + out + ": this is the file of the map " + map +
                                        ", which mdof would overwrite; give another file");
  return {};
}

bool are_identical(const SurfaceMap& a, const SurfaceMap& b) {
  const auto same = [](double x, double y) { return x == y || (std::isnan(x) && std::isnan(y)); };
  return a.nx == b.nx && a.ny == b.ny && a.x0_m == b.x0_m && a.y0_m == b.y0_m && a.dx_m == b.dx_m &&
         a.dy_m == b.dy_m && std::equal(a.z_m.begin(), a.z_m.end(), b.z_m.begin(), same);
}

Status check_distinct(const std::vector<const SurfaceMap*>& maps) {
  for (std::size_t i = 0; i < maps.size(); ++i)
    for (std::size_t j = 0; j < i; ++j)
      if (are_identical(*maps[j], *maps[i]))
        return bad_input(maps[i]->name + ": this map is identical to " + maps[j]->name +
                         ", so one measurement was probably given twice; give each map its own "
                         "measurement");
  return {};
}

bool has_few_common_pixels(std::size_t common, std::size_t measured) {
  return 10 * common < 9 * measured;
}

void warn_few_common_pixels(const SurfaceMap& map, std::size_t common, const std::string& rest) {
  const std::size_t measured = map.measured();
  if (!has_few_common_pixels(common, measured)) return;
  warn(map.name + ": the map has " + std::to_string(measured) + " measured pixels, but only " +
       std::to_string(common) + " of these pixels are measured in all maps; " + rest);
}

Notices mirrored_notices(const SurfaceMap& before, const std::vector<const SurfaceMap*>& maps) {
  Notices notices;
  for (const SurfaceMap* map : maps)
    if (const auto match = algo::mirrored_match(before, *map))
      notices.push_back(notice(NoticeCode::map_matches_mirrored, map->name,
                               {{"mirrored", match->mirrored},
                                {"rms_um", to_um(match->rms_m)},
                                {"mirrored_rms_um", to_um(match->mirrored_rms_m)}}));
  return notices;
}

void add_map_options(CLI::App& command, MapOptions& options) {
  command
      .add_option("--unit", options.unit,
                  "Unit of maps without header (XYZ): m, mm, um or nm; or two units, the first for "
                  "x and y, the second for z [default: mm,um]")
      ->type_name("NAME");
  add_database_option(command, options.database);
}

Result<daemon::RadialScan> load_scan(const std::vector<std::int64_t>& runs,
                                     std::optional<double> pixel_m, const std::string& database) {
  MDOF_TRY(store::Store store, open_to_read(database));
  MDOF_TRY(daemon::RadialScan scan, daemon::radial_scan(store, runs, pixel_m));
  if (scan.simulated) warn(scan.map.name + ": simulated data: no machine was measured");
  if (scan.beyond_targets > 0)
    warn(scan.map.name + ": " + std::to_string(scan.beyond_targets) +
         " heights beyond the targets of the run are left out");
  if (scan.other_direction > 0)
    warn(scan.map.name + ": " + std::to_string(scan.other_direction) +
         " heights are left out, because the axis moved in a direction in which fewer than three "
         "targets have error values; measure the targets in both directions to use these heights");
  if (scan.unplaced_heights > 0)
    warn(scan.map.name + ": " + std::to_string(scan.unplaced_heights) +
         " heights without encoder or angle value are left out");
  return scan;
}

Result<SurfaceMap> load_map(const std::string& file, const MapOptions& options) {
  if (const auto run = scanned_run_number(file)) {
    MDOF_TRY(daemon::RadialScan scan, load_scan({*run}, std::nullopt, options.database));
    return std::move(scan.map);
  }
  std::optional<XyzUnits> units;
  if (!options.unit.empty()) {
    auto named = xyz_units(options.unit);
    if (!named) return in_context("--unit", std::move(named.error()));
    units = *named;
  }
  MapReader reader(file, units);
  MDOF_CHECK(read_in_pieces(file, [&](std::string_view piece) { return reader.take(piece); }));
  MDOF_TRY(SurfaceMap map, reader.map());
  if (units && reader.states_units())
    warn(file + ": --unit is not used for this map, because the file states its units");
  show_notices(map.notices, true);
  return map;
}

Status save_maps(const SurfaceMap& map, const std::string& out, const std::vector<DrawnMap>& drawn,
                 const std::string& folder) {
  OutputFiles files(Existing::replace);
  if (!out.empty()) {
    MDOF_TRY(const std::size_t file, files.add(out));
    MDOF_CHECK(write_map_csv(map, [&](std::string_view text) { return files.write(file, text); }));
  }
  std::vector<charts::NamedChart> drawings;
  for (const DrawnMap& each : drawn) {
    if (folder.empty()) break;
    if (each.map.measured() > 0)
      drawings.push_back({each.file + ".svg",
                          charts::height_map_svg(each.map, each.title, output::Language::english)});
    else
      warn(each.title + ": not drawn, because no pixel has a height");
  }
  std::vector<std::string> plots;
  if (!drawings.empty()) {
    MDOF_TRY(plots, charts::add_charts(drawings, folder, files));
  }
  MDOF_CHECK(files.publish());
  for (const std::string& plot : plots) say("plot: " + plot);
  return {};
}

void write_um(JsonWriter& json, const char* key, double pv_m, double rms_m) {
  json.key(key)
      .begin_object()
      .field("pv_um", to_um(pv_m))
      .field("rms_um", to_um(rms_m))
      .end_object();
}

}  // namespace mdof::tools
