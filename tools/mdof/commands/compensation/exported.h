// Converts compensation tables to the files of a controller and checks the files. `compensation
// export` and `compensation check` use these functions.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "algo/compensation/residual_limits.h"
#include "daemon/measure/gate/gate.h"
#include "daemon/output/controllers/check.h"
#include "schema/base/result.h"
#include "schema/units.h"
#include "tools/mdof/options.h"

namespace CLI {
class App;
}

namespace mdof::tools {

struct ExportRequest {
  std::string database, format;
  std::vector<std::int64_t> tables;
  std::string squareness;  // Number of a squareness, or "latest"; it is exported instead of tables.
  double tolerance_um = 0;
  std::string home_mm;  // Home positions of the axes: "10" or "X=10,Y=20"; empty: not stated.
  double residual_um = to_um(algo::ResidualLimits{}.most_m);
  double residual_percent = 100 * algo::ResidualLimits{}.share;
  std::string joints, units = "mm";              // LinuxCNC only: "Y=1,Y=3".
  std::optional<double> max_acceleration_mm_s2;  // LinuxCNC only: the value of all joints.
  std::string ini;  // LinuxCNC only: ini file with the limits of each joint.
  std::size_t siemens_points = 0, siemens_tables = 0;  // Limits; 0: default.
  bool one_approach = false;
  LimitOptions limits;
  bool cut_range = false, not_active = false, unverified_sign = false;
  daemon::Consent consent;
};
// `remark`: a text for the help of the options that accept simulated data, warnings or inactive
// tables. It states the effect of these options, and may be empty.
void add_export_options(CLI::App& command, ExportRequest& request, const std::string& remark);
// Error: the format is missing or unknown, or mdof cannot write it.
Result<const controllers::Format*> format_of(const ExportRequest& request);

struct ExportedTables {
  const controllers::Format* format = nullptr;
  std::vector<std::int64_t> tables;
  std::int64_t squareness = 0;  // 0: tables are exported.
  Budget angle;                 // Uncertainty budget of EC0Y, if a squareness is exported.
  bool simulated = false, doubtful = false;  // True if at least one table has this property.
  controllers::ExportOptions options;
  controllers::Export files;
  controllers::Check check;
};
// Reads the tables, converts them to files, and checks the files. Errors:
// - a format, an option or a table is missing or unknown
// - a table is simulated, has warnings, or is not active, or the sign of the format is not
// confirmed, and no option accepts this
// - the format cannot store the contents of a table
Result<ExportedTables> exported_tables(const ExportRequest& request);

std::string check_json(const ExportedTables& exported);
std::string check_text(const controllers::Check& check);

}  // namespace mdof::tools
