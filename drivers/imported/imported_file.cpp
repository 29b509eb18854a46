#include "drivers/imported/imported_file.h"

#include <algorithm>
#include <cmath>
#include <filesystem>

#include "drivers/csv/csv_table.h"
#include "drivers/csv/positioning_csv.h"
#include "drivers/imported/rtl.h"
#include "schema/base/files.h"
#include "schema/base/number/number_text.h"
#include "schema/base/sha256.h"
#include "schema/recording/probe_log.h"
#include "schema/units.h"

namespace mdof::drivers {
namespace {

constexpr double kMostRuns = 1e6;

bool has_column(const std::string& text, const char* name) {
  const auto header = parse_csv_header(text, CsvKind::table, "");
  return header &&
         std::find(header->columns.begin(), header->columns.end(), name) != header->columns.end();
}

std::string format_of(const std::string& text) {
  if (text.find("DEVIATIONS::") != text.npos) return "rtl";
  return has_column(text, "target_mm") ? "iso230-2" : "csv";
}

Result<ImportedSeries> read_positioning_series(const std::string& path, int descriptor) {
  MDOF_TRY(const PositioningCsv csv, read_positioning_csv(path, kMostImportedReadings, descriptor));
  ImportedSeries series;
  series.simulated = csv.simulated;
  for (const PositioningReading& r : csv.readings)
    series.readings.push_back({r.target_m, r.direction, r.run, r.deviation});
  return series;
}

Result<ImportedSeries> read_csv_series(const std::string& path, bool angle, int descriptor) {
  const std::string deviation = angle ? "deviation_urad" : "deviation_um";
  MDOF_TRY(const CsvTable table,
           read_csv_table(path, {"position_mm", deviation}, {"direction", "run"},
                          kMostImportedReadings, descriptor));
  const auto &direction = table.columns[2], &run = table.columns[3];
  ImportedSeries series;
  series.simulated = table.simulated;
  for (std::size_t row = 0; row < table.rows(); ++row) {
    ImportedReading r{from_mm(table.columns[0][row]), 0, 1, from_um(table.columns[1][row])};
    if (!direction.empty()) {
      if (std::abs(direction[row]) != 1)
        return bad_input(table.where(row) + "column direction: " + plain_number(direction[row]) +
                         "; give 1 (approached in the + direction) or -1 (in the - direction)");
      r.direction = direction[row] > 0 ? 1 : -1;
    }
    if (!run.empty()) {
      if (run[row] != std::floor(run[row]) || !(std::abs(run[row]) <= kMostRuns))
        return bad_input(table.where(row) + "column run: " + plain_number(run[row]) +
                         "; use the run numbers 1, 2, 3 ...");
      r.run = static_cast<int>(run[row]);
    }
    series.readings.push_back(r);
  }
  return series;
}

Result<ImportedSeries> read(const std::string& path, const std::string& text,
                            const std::string& format, const std::string& source,
                            const ExpectedError& error, int descriptor) {
  if (error.angle && format != "csv")
    return fail(ErrorCode::usage,
                "angles can be imported only from a CSV file with the columns position_mm and "
                "deviation_urad");
  if (format == "csv" && !error.angle && has_column(text, "deviation_urad") &&
      !has_column(text, "deviation_um"))
    return bad_input(source +
                         ": the column deviation_urad contains an angular error, but the error of "
                         "this import is a length",
                     Remedy::name_angular_error);
  if (format == "rtl") return parse_rtl(text, source, error.is_stated);
  return format == "iso230-2" ? read_positioning_series(path, descriptor)
                              : read_csv_series(path, error.angle, descriptor);
}

}  // namespace

Result<ImportedSeries> read_imported_file(const std::string& path, const std::string& asked,
                                          const ExpectedError& error, int descriptor) {
  MDOF_TRY(const std::string text,
           read_text_file(descriptor < 0 ? path : "/proc/self/fd/" + std::to_string(descriptor)));
  const std::string format = asked.empty() ? format_of(text) : asked;
  const std::string source = std::filesystem::path(path).filename().string();
  MDOF_TRY(ImportedSeries series, read(path, text, format, source, error, descriptor));
  if (series.readings.empty()) return bad_input(source + ": has no readings");
  series.format = format;
  series.source = source;
  series.sha256 = sha256_hex(text);
  return series;
}

}  // namespace mdof::drivers
