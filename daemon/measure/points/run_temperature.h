// Temperature of a run, from the column or the channel "temperature" in °C.
#pragma once

#include <cstdint>
#include <optional>

#include "schema/notice/notice.h"
#include "schema/run.h"
#include "schema/sample.h"

namespace mdof::daemon {

class RunTemperature {
 public:
  void push(
      const SampleBlock& raw);  // ignores samples without a value or without a plausible value
  std::optional<Temperature> of_run() const;
  std::optional<Notice> left_out() const;  // if values were not plausible

 private:
  // The member mean_C contains the sum of the samples; of_run() divides the sum by n_.
  Temperature sum_;
  std::uint64_t n_ = 0, left_out_ = 0;
  double first_left_out_C_ = 0;
};

}  // namespace mdof::daemon
