// Brings what the encoder of an axis shows to the machine's positions, before it is recorded or
// measured. An encoder that counts starts at 0 wherever the axis stands: somebody has to say where
// that is.
#pragma once

#include <cstdint>
#include <mutex>
#include <string>
#include <vector>

#include "drivers/registry.h"
#include "schema/base/result.h"
#include "schema/encoder_datum.h"
#include "schema/sample.h"

namespace mdof::daemon {

// datum() from any thread, all others from one, the measuring one.
class EncoderZero {
 public:
  explicit EncoderZero(const std::vector<drivers::DriverSpec>& devices);

  // Adds the offset to the encoder's values of `block`, where it has any, and keeps what it shows.
  void apply(SampleBlock& block);
  // The axis stands at `position_m` now. Error (conflict): it has not been still for 0.2 s, or
  // nothing has come from its encoder for a second.
  Result<EncoderDatum> set(double position_m, const std::string& utc, const std::string& by);
  // Its device counts from elsewhere now.
  void lose(const std::string& device);

  EncoderDatum datum() const;
  // The device that gives the encoder; "": not known before it gave some.
  std::string device() const;

 private:
  void watch(double shown_m, std::int64_t time_ns);

  mutable std::mutex mutex_;
  EncoderDatum datum_;  // guarded by mutex_
  std::string device_;  // guarded by mutex_

  // Of the values with their offset, since the axis came to rest.
  double rest_m_ = 0, sum_m_ = 0;
  std::uint64_t count_ = 0;
  std::int64_t since_ns_ = 0, last_ns_ = 0;
};

}  // namespace mdof::daemon
