// Converts the readings of the encoder of an axis to machine positions. This is done before the
// samples are recorded and measured. After power-on, an incremental encoder reads 0 at any axis
// position. Therefore a user must set the axis position.
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

// The current datum of the encoder. `notice`: set if the datum is missing or was lost. `note`: the
// text of the notice; without a notice, a text that states who set the position and when; "" if no
// position was set.
struct EncoderState {
  EncoderDatum datum;
  std::optional<Notice> notice;
  std::string note;
};

// datum(), state() and device() are thread-safe. Call all other functions on the measure thread.
class EncoderZero {
 public:
  // `before`: the last position that was set before this program started. This position is no
  // longer valid. `um_per_V`: scale of an encoder whose readings are in volts.
  explicit EncoderZero(const std::vector<drivers::DriverSpec>& devices,
                       std::optional<DatumSetting> before = std::nullopt,
                       std::optional<double> um_per_V = std::nullopt);

  // Adds the offset of the datum to the encoder values in `block`. Also updates the mean position
  // at rest.
  void apply(SampleBlock& block);
  // Calculates the setting of the datum so that the current axis position becomes `position_m`. The
  // setting is not applied yet. Error (conflict): the axis was not at rest during the last 0.2 s,
  // or the encoder has sent no sample for 1 s.
  Result<DatumSetting> find(Axis axis, double position_m, const std::string& utc);
  // Applies the setting from find(). Error (conflict): after find(), the device lost power or the
  // encoder passed its reference mark.
  Result<EncoderDatum> put(const DatumSetting& setting, const std::string& by);
  // The device has lost its count. The count now has a new, unknown origin.
  void lose(const std::string& device);
  // From now, the device counts from its reference mark. This replaces any other datum. Returns
  // false if the encoder belongs to another device, or if the configuration states no position of
  // the mark.
  bool pass_mark(const std::string& device, const std::string& utc);

  EncoderDatum datum() const;
  EncoderState state() const;
  // Notes that this run begins with the present origin of the count.
  void begins(std::int64_t run);
  // Whether the origin of the count is the same as at the beginning of the run. False if the run
  // began before this program started, or before the device lost power: the origin is then unknown.
  // Always true for an absolute encoder.
  bool has_counted_since(std::int64_t run) const;
  // The device that provides the encoder. It can be unknown ("") before the first sample.
  std::string device() const;

 private:
  std::optional<Notice> missing() const;
  double metres_per(Unit unit) const;
  void watch(double shown_m, std::int64_t time_ns);

  const std::optional<double> um_per_V_;
  mutable std::mutex mutex_;
  EncoderDatum datum_;   // protected by mutex_
  bool counts_ = false;  // protected by mutex_
  // Runs that began with the current origin of the count; protected by mutex_.
  std::set<std::int64_t> runs_;
  std::string device_;             // protected by mutex_
  std::optional<double> index_m_;  // axis position at the reference mark of the encoder
  // The last setting. since_start_: whether the last setting was made after this program started.
  // Protected by mutex_.
  std::optional<DatumSetting> last_;
  bool since_start_ = false;
  bool found_ = false;  // set by find(), reset when the count gets a new origin

  // Statistics of the positions (with offset) since the axis stopped.
  double rest_m_ = 0, sum_m_ = 0;
  std::uint64_t count_ = 0;
  std::int64_t since_ns_ = 0, last_ns_ = 0;
};

}  // namespace mdof::daemon
