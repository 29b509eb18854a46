// Converts the readings of an axis' encoder to positions of the machine before they are recorded or
// measured. An incremental encoder starts at 0 at any position of the axis, so a user must set the
// position.
#pragma once

#include <cstdint>
#include <mutex>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "drivers/driver_spec.h"
#include "schema/base/result.h"
#include "schema/encoder_datum.h"
#include "schema/sample.h"

namespace mdof::daemon {

// The present datum, and a notice if it is missing or was lost. `note` is the text of the notice,
// otherwise the text of the setting; "": neither.
struct EncoderState {
  EncoderDatum datum;
  std::optional<Notice> notice;
  std::string note;
};

// datum(), state() and device() are thread-safe. Call all others from the measure thread.
class EncoderZero {
 public:
  // `um_per_V`: for an encoder in volts. `before`: the last setting before this program started,
  // which is no longer valid.
  explicit EncoderZero(const std::vector<drivers::DriverSpec>& devices,
                       std::optional<DatumSetting> before = std::nullopt,
                       std::optional<double> um_per_V = std::nullopt);

  // Adds the offset to the encoder's values in `block`, if any, and keeps the readings.
  void apply(SampleBlock& block);
  // The setting for an axis that is now at `position_m`; it is not yet applied. Error (conflict):
  // the axis has not been at rest for 0.2 s, or its encoder has sent nothing for 1 s.
  Result<DatumSetting> find(Axis axis, double position_m, const std::string& utc);
  // Applies the setting. Error (conflict): the device has lost power, or its reference mark was
  // passed, since find().
  Result<EncoderDatum> put(const DatumSetting& setting, const std::string& by);
  // The device's count has a new, unknown origin.
  void lose(const std::string& device);
  // From now on the device counts from its reference mark; this replaces any other datum. False:
  // the device does not give the encoder, or the configuration uses no mark.
  bool pass_mark(const std::string& device, const std::string& utc);

  EncoderDatum datum() const;
  EncoderState state() const;
  // A run begins.
  void begins(std::int64_t run);
  // Whether the encoder has counted from the same origin since the run began. False if unknown: the
  // run began before this program, or before its device lost power. Always true for an encoder that
  // does not count.
  bool has_counted_since(std::int64_t run) const;
  // The device that gives the encoder; "": unknown before its first sample.
  std::string device() const;

 private:
  std::optional<Notice> missing() const;
  double metres_per(Unit unit) const;
  void watch(double shown_m, std::int64_t time_ns);

  const std::optional<double> um_per_V_;
  mutable std::mutex mutex_;
  EncoderDatum datum_;             // protected by mutex_
  bool counts_ = false;            // protected by mutex_
  std::set<std::int64_t> runs_;    // since the present origin of the count; protected by mutex_
  std::string device_;             // protected by mutex_
  std::optional<double> index_m_;  // axis position at the encoder's reference mark
  // The last setting, before or since the start of this program. Protected by mutex_.
  std::optional<DatumSetting> last_;
  bool since_start_ = false;
  bool found_ = false;  // set by find(), reset when the count gets a new origin

  // Statistics of the values with their offset since the axis stopped.
  double rest_m_ = 0, sum_m_ = 0;
  std::uint64_t count_ = 0;
  std::int64_t since_ns_ = 0, last_ns_ = 0;
};

}  // namespace mdof::daemon
