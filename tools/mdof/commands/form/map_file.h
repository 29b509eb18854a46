// Height maps as arguments of a command: files in each known form, and runs that scanned a part.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "daemon/measure/replay/radial_scan.h"
#include "schema/base/json_writer.h"
#include "schema/base/result.h"
#include "schema/form/height_map.h"

namespace CLI {
class App;
}

namespace mdof::tools {

struct MapOptions {
  std::string unit, database;
};
// The run number in "run:12", or in "12" if no file has this name.
std::optional<std::int64_t> scanned_run_number(const std::string& name);

// Error (usage): `out` is the file of one of these maps and would be overwritten.
Status check_out(const std::string& out, const std::vector<std::string>& maps);

// True if `common` is less than nine tenths of the measured pixels.
bool has_few_common_pixels(std::size_t common, std::size_t measured);
// Warns if `common` is less than nine tenths of the measured pixels of `map`. `rest`: what happens
// to the other pixels.
void warn_few_common_pixels(const SurfaceMap& map, std::size_t common, const std::string& rest);

void add_map_options(CLI::App& command, MapOptions& options);

// Loads a file, recognised by its content: .sdf, Zygo .dat, CSV, XYZ; or a run: "run:12", or "12"
// if no file has this name. Prints assumptions about the file as warnings.
Result<SurfaceMap> load_map(const std::string& file, const MapOptions& options);

// Joins these runs into one scan. Prints as warnings which heights are left out.
Result<daemon::RadialScan> load_scan(const std::vector<std::int64_t>& runs,
                                     std::optional<double> pixel_m, const std::string& database);

// Writes CSV, either completely or not at all; replaces an existing file.
Status save_map(const SurfaceMap& map, const std::string& file);

// A map to draw: file name without ending, and title.
struct DrawnMap {
  std::string file, title;
  const SurfaceMap& map;
};
// Writes SVG files into `folder`; empty: writes none. Leaves out a map without heights and says so.
Status plot_maps(const std::vector<DrawnMap>& maps, const std::string& folder);

void write_um(JsonWriter& json, const char* key, double pv_m, double rms_m);  // {pv_um, rms_um}

}  // namespace mdof::tools
