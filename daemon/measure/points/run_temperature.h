// Temperature of a run, from the column or the channel "temperature" in °C.
#pragma once

#include <cstdint>
#include <optional>

#include "schema/run.h"
#include "schema/sample.h"

namespace mdof::daemon {

class RunTemperature {
 public:
  void push(const SampleBlock& raw);  // ignores samples without a value
  std::optional<Temperature> of_run() const;

 private:
  // The member mean_C contains the sum of the samples; of_run() divides the sum by n_.
  Temperature sum_;
  std::uint64_t n_ = 0;
};

}  // namespace mdof::daemon
