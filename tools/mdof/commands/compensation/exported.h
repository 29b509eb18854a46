// Reads, judges, writes and checks tables for a controller. `compensation export` and `compensation
// check` share this code.
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
  std::string squareness;  // A number or "latest"; replaces tables.
  double tolerance_um = 0;
  std::string home_mm;  // "10", "X=10,Y=20"; empty: not given.
  double residual_um = to_um(algo::ResidualLimits{}.most_m);
  double residual_percent = 100 * algo::ResidualLimits{}.share;
  std::string joints, units = "mm";              // LinuxCNC only: "Y=1,Y=3".
  std::optional<double> max_acceleration_mm_s2;  // LinuxCNC only: of every joint.
  std::string ini;                               // LinuxCNC only: has the limits of each joint.
  std::size_t siemens_points = 0, siemens_tables = 0;  // 0: default.
  bool one_approach = false;
  LimitOptions limits;
  bool cut_range = false, not_active = false, unverified_sign = false;
  daemon::Consent consent;
};
// `remark`: the consequence of accepting simulated data, warnings or an inactive table; may be
// empty.
void add_export_options(CLI::App& command, ExportRequest& request, const std::string& remark);
// Error: the format is missing or unknown, or mdof cannot write it.
Result<const controllers::Format*> format_of(const ExportRequest& request);

struct ExportedTables {
  const controllers::Format* format = nullptr;
  std::vector<std::int64_t> tables;
  std::int64_t squareness = 0;               // 0: tables are exported.
  Budget angle;                              // Budget of EC0Y, if a squareness is exported.
  bool simulated = false, doubtful = false;  // True if it applies to any table.
  controllers::ExportOptions options;
  controllers::Export files;
  controllers::Check check;
};
// Errors: a missing or unknown format, option or table; a table that is simulated, doubtful, not
// active or has an unconfirmed sign, unless an option accepts it; content that the format cannot
// hold.
Result<ExportedTables> exported_tables(const ExportRequest& request);

std::string check_json(const ExportedTables& exported);
std::string check_text(const controllers::Check& check);

}  // namespace mdof::tools
