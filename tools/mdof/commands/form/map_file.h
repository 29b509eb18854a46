// Height maps as arguments of a command: files of each known form, and runs that scanned a part.
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
// The run of "run:12", and of "12" where no file is called so.
std::optional<std::int64_t> run_of_map(const std::string& name);

// Error usage: `out` is the file of one of these maps, which would be overwritten.
Status check_out(const std::string& out, const std::vector<std::string>& maps);

// Less than nine tenths of the measured pixels.
bool is_few(std::size_t common, std::size_t measured);
// A warning where `common` pixels are less than nine tenths of those of `map`; `rest`: what becomes
// of the others.
void warn_of_few(const SurfaceMap& map, std::size_t common, const std::string& rest);

void add_map_options(CLI::App& command, MapOptions& options);

// A file, recognised by what is in it: .sdf, Zygo .dat, CSV, XYZ; or "run:12", and "12" where no
// file is called so. What was assumed of it is said as a warning.
Result<SurfaceMap> load_map(const std::string& file, const MapOptions& options);

// Of these runs together; what was left out of them is said as a warning.
Result<daemon::RadialScan> load_scan(const std::vector<std::int64_t>& runs,
                                     std::optional<double> pixel_m, const std::string& database);

// As CSV, whole or not at all; replaces a file of that name.
Status save_map(const SurfaceMap& map, const std::string& file);

// A map as a picture: the file's name without its ending, and a title.
struct DrawnMap {
  std::string file, title;
  const SurfaceMap& map;
};
// As SVG into `folder`; empty: none. A map without a height is left out, which is said.
Status plot_maps(const std::vector<DrawnMap>& maps, const std::string& folder);

void write_um(JsonWriter& json, const char* key, double pv_m, double rms_m);  // {pv_um, rms_um}

}  // namespace mdof::tools
