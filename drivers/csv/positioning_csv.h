// Readings of a test to ISO 230-2 as CSV: columns target_mm, direction (1 or -1), run,
// deviation_um, one row a reading, in any order.
#pragma once

#include <string>
#include <vector>

#include "schema/base/result.h"
#include "schema/iso230/positioning.h"

namespace mdof::drivers {

struct PositioningCsv {
  std::string source;      // file name, for messages
  bool simulated = false;  // a comment says so
  std::vector<PositioningReading> readings;
};

// Errors name file, line, column and remedy: those of read_csv_table(); a direction that is not 1
// or -1; a run that is no whole number; a run that has a target from one side twice; more readings
// than `most`, of which each takes some 120 bytes of memory. `descriptor`: as there.
inline constexpr std::size_t kMostReadings = 1'000'000;
Result<PositioningCsv> read_positioning_csv(const std::string& path,
                                            std::size_t most = kMostReadings, int descriptor = -1);

}  // namespace mdof::drivers
