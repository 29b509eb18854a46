// The temperature of a run: of the column or channel "temperature" in °C, where there is one.
#pragma once

#include <cstdint>
#include <optional>

#include "schema/run.h"
#include "schema/sample.h"

namespace mdof::daemon {

class RunTemperature {
 public:
  void push(const SampleBlock& raw);  // cells without a value are passed over
  std::optional<Temperature> of_run() const;

 private:
  Temperature sum_;  // mean_C: the sum of
  std::uint64_t n_ = 0;
};

}  // namespace mdof::daemon
