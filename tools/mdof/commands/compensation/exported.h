// Tables that are to go to a controller: read, judged, written and checked. What `compensation
// export` and `compensation check` have in common.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "daemon/output/controllers/check.h"
#include "schema/base/result.h"

namespace CLI {
class App;
}

namespace mdof::tools {

struct ExportRequest {
  std::string database, format;
  std::vector<std::int64_t> tables;
  double tolerance_um = 0, home_mm = 0;
  bool home_given = false, cut_range = false, simulated = false, not_in_force = false,
       unverified_sign = false;
};
void add_export_options(CLI::App& command, ExportRequest& request);

struct ExportedTables {
  const controllers::Format* format = nullptr;
  std::vector<CompensationTable> tables;
  controllers::ExportOptions options;
  controllers::Export files;
  controllers::Check check;
};
// Errors: a format, an option or a table that is not there; a table that is simulated, not in force
// or whose sign is not confirmed, unless that is asked for; what the format cannot hold.
Result<ExportedTables> exported_tables(const ExportRequest& request);

std::string check_json(const controllers::Check& check);
std::string check_text(const controllers::Check& check);

}  // namespace mdof::tools
