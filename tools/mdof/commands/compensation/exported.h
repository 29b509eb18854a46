// Tables that are to go to a controller: read, judged, written and checked. What `compensation
// export` and `compensation check` have in common.
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
  std::string squareness;  // its number or "latest"; instead of tables
  double tolerance_um = 0;
  std::string home_mm;  // "10", "X=10,Y=20"; empty: not given
  double residual_um = to_um(algo::ResidualLimits{}.most_m);
  double residual_percent = 100 * algo::ResidualLimits{}.share;
  std::string joints, units = "mm";                    // "Y=1,Y=3"; of LinuxCNC
  std::optional<double> max_acceleration_mm_s2;        // of LinuxCNC, of every joint
  std::string ini;                                     // of LinuxCNC: says the same of each joint
  std::size_t siemens_points = 0, siemens_tables = 0;  // 0: the default
  bool one_approach = false;
  LimitOptions limits;
  bool cut_range = false, not_active = false, unverified_sign = false;
  daemon::Consent consent;
};
// `remark`: what accepting simulated data, warnings or a table that is not active brings; or "".
void add_export_options(CLI::App& command, ExportRequest& request, const std::string& remark);
// Error: it is missing or unknown, or mdof does not write it.
Result<const controllers::Format*> format_of(const ExportRequest& request);

struct ExportedTables {
  const controllers::Format* format = nullptr;
  std::vector<std::int64_t> tables;
  std::int64_t squareness = 0;               // 0: tables
  Budget angle;                              // of EC0Y, of a squareness
  bool simulated = false, doubtful = false;  // any of them
  controllers::ExportOptions options;
  controllers::Export files;
  controllers::Check check;
};
// Errors: a format, an option or a table that is not there; a table that is simulated, doubtful,
// not active or whose sign is not confirmed, unless that is asked for; what the format cannot
// hold.
Result<ExportedTables> exported_tables(const ExportRequest& request);

std::string check_json(const ExportedTables& exported);
std::string check_text(const controllers::Check& check);

}  // namespace mdof::tools
