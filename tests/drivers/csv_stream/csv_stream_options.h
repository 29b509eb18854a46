// Options of a csv_stream with the channels encoder, A and B.
#pragma once

#include "drivers/csv_stream/csv_stream.h"

namespace mdof::drivers {

inline CsvStreamOptions options_for_test() {
  CsvStreamOptions options;
  options.expected = {"encoder", "A", "B"};
  return options;
}

}  // namespace mdof::drivers
