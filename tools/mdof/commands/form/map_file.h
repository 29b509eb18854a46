// Reads the height maps that a command names: files in several formats, and runs that scanned a
// part.
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
// The run number in the text "run:12", or in "12" if there is no file "12".
std::optional<std::int64_t> scanned_run_number(const std::string& name);

// Error (usage): the output file `out` is one of the input files `maps`.
Status check_out(const std::string& out, const std::vector<std::string>& maps);

// True if both maps have the same pixels with the same heights.
bool are_identical(const SurfaceMap& a, const SurfaceMap& b);
// Error (bad_input): two of the maps are identical, so one file was probably given twice.
Status check_distinct(const std::vector<const SurfaceMap*>& maps);

// True if `common` < 0.9 `measured` (numbers of pixels).
bool has_few_common_pixels(std::size_t common, std::size_t measured);
// Prints a warning if has_few_common_pixels() is true for the measured pixels of `map`. `rest`: a
// text for the warning that states what happens to the other pixels.
void warn_few_common_pixels(const SurfaceMap& map, std::size_t common, const std::string& rest);

// A notice for each map that matches `before` better if it is mirrored.
Notices mirrored_notices(const SurfaceMap& before, const std::vector<const SurfaceMap*>& maps);

void add_map_options(CLI::App& command, MapOptions& options);

// Loads the map of a run ("run:12", or "12" if there is no file "12") or of a file. The content of
// the file decides its format: .sdf, Zygo .dat, CSV or XYZ. Prints a warning for each assumption
// about the file.
Result<SurfaceMap> load_map(const std::string& file, const MapOptions& options);

// Joins these runs to one scan. Prints a warning for heights that are left out.
Result<daemon::RadialScan> load_scan(const std::vector<std::int64_t>& runs,
                                     std::optional<double> pixel_m, const std::string& database);

// A map that is drawn. `file`: file name without ".svg".
struct DrawnMap {
  std::string file, title;
  const SurfaceMap& map;
};
// Writes `map` to the file `out` (CSV), and an SVG file for each drawn map into `folder`. An empty
// name: not written. Replaces existing files. If a file cannot be written, no file is written.
// Prints a message for each drawn map without heights, which is left out.
Status save_maps(const SurfaceMap& map, const std::string& out, const std::vector<DrawnMap>& drawn,
                 const std::string& folder);

void write_um(JsonWriter& json, const char* key, double pv_m, double rms_m);  // {pv_um, rms_um}

}  // namespace mdof::tools
