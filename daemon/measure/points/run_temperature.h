// Temperature of a run, from the column or channel "temperature" in °C, if there is one.
#pragma once

#include <cstdint>
#include <optional>

#include "schema/run.h"
#include "schema/sample.h"

namespace mdof::daemon {

class RunTemperature {
 public:
  void push(const SampleBlock& raw);  // cells without a value are skipped
  std::optional<Temperature> of_run() const;

 private:
  Temperature sum_;  // mean_C contains the sum until of_run() divides it
  std::uint64_t n_ = 0;
};

}  // namespace mdof::daemon
