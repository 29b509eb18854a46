// Height maps as arguments of a command: files of each known form.
#pragma once

#include <string>

#include "schema/base/json_writer.h"
#include "schema/base/result.h"
#include "schema/form/height_map.h"

namespace CLI {
class App;
}

namespace mdof::tools {

struct MapOptions {
  std::string unit;
};
void add_map_options(CLI::App& command, MapOptions& options);

// Told by what is in it: .sdf, Zygo .dat, CSV, XYZ. What was assumed of it is said as a warning.
Result<SurfaceMap> load_map(const std::string& file, const MapOptions& options);

// As CSV, whole or not at all; replaces a file of that name.
Status save_map(const SurfaceMap& map, const std::string& file);

void write_um(JsonWriter& json, const char* key, double pv_m, double rms_m);  // {pv_um, rms_um}

}  // namespace mdof::tools
