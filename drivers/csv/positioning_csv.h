// Reads the CSV file of a test according to ISO 230-2. Columns: target_mm, direction (1 or -1),
// run, deviation_um. There is one row for each reading; the rows may have any order.
#pragma once

#include <string>
#include <vector>

#include "schema/base/result.h"
#include "schema/iso230/positioning.h"

namespace mdof::drivers {

struct PositioningCsv {
  std::string source;      // file name, for messages
  bool simulated = false;  // true: a comment in the file states that the data are simulated
  std::vector<PositioningReading> readings;
};

// Errors name file, line, column and remedy: the errors of read_csv_table(); a direction that is
// neither 1 nor -1; a run that is not an integer; two readings with the same target, direction and
// run; more than `most` readings (each reading needs about 120 bytes of memory). `descriptor`: as
// in read_csv_table().
inline constexpr std::size_t kMostReadings = 1'000'000;
Result<PositioningCsv> read_positioning_csv(const std::string& path,
                                            std::size_t most = kMostReadings, int descriptor = -1);

}  // namespace mdof::drivers
