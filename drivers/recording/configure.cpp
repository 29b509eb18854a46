#include "drivers/recording/configure.h"

#include <filesystem>
#include <string>

#include "drivers/csv/csv_log.h"
#include "drivers/recording/recording_log.h"

namespace mdof::drivers {
namespace {

template <class Log>
SourceInfo info_of(const Driver& driver) {
  const auto& log = static_cast<const Log&>(driver);
  return {log.sha256(), log.notices()};
}

DriverSpec log_driver(const std::string& name, const std::string& path) {
  DriverSpec spec;
  spec.live = false;
  spec.recorded = false;
  spec.source_path = std::filesystem::absolute(path).string();
  if (is_recording(path)) {
    spec.make = make_of<RecordingLog>(name, path);
    spec.source_info = info_of<RecordingLog>;
  } else {
    spec.make = make_of<CsvLog>(path);
    spec.source_info = info_of<CsvLog>;
  }
  return spec;
}

}  // namespace

Result<DriverSpec> configure_replay(TomlTable& table, const DriverContext& context) {
  const std::string file = table.string("file");
  MDOF_CHECK(table.finish());
  const auto path = std::filesystem::path(context.base_path) / file;
  std::error_code ec;  // an unreadable path is treated as a missing file
  if (!std::filesystem::is_regular_file(path, ec)) {
    return bad_input(table.where("file") + ": " + path.string() +
                     " is not a readable file; give the path of a recording or of a probe log");
  }
  return log_driver(context.name, path.string());
}

}  // namespace mdof::drivers
