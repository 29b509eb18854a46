// Brings what the encoder of an axis shows to the machine's positions, before it is recorded or
// measured. An encoder that counts starts at 0 wherever the axis stands: somebody has to say where
// that is.
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

// What holds now, and what is missing of it or lost. For people the words of that, else what was
// said; "": nothing.
struct EncoderState {
  EncoderDatum datum;
  std::optional<Notice> notice;
  std::string note;
};

// datum(), state() and device() from any thread, all others from one, the measuring one.
class EncoderZero {
 public:
  // `um_per_V`: of an encoder that gives volts. `before`: what was said last before this program
  // began, which it does not hold any more.
  explicit EncoderZero(const std::vector<drivers::DriverSpec>& devices,
                       std::optional<DatumSetting> before = std::nullopt,
                       std::optional<double> um_per_V = std::nullopt);

  // Adds the offset to the encoder's values of `block`, where it has any, and keeps what it shows.
  void apply(SampleBlock& block);
  // What it means that the axis stands at `position_m` now; nothing is changed yet. Error
  // (conflict): it has not been still for 0.2 s, or nothing has come from its encoder for a second.
  Result<DatumSetting> find(Axis axis, double position_m, const std::string& utc);
  // It holds from now on. Error (conflict): its device has been without power since it was found.
  Result<EncoderDatum> put(const DatumSetting& setting, const std::string& by);
  // Its device counts from elsewhere from now on.
  void lose(const std::string& device);
  // Its device counts from its reference mark from now on, whatever held before. False: it is not
  // the one that gives the encoder, or not asked to look for a mark.
  bool pass_mark(const std::string& device, const std::string& utc);

  EncoderDatum datum() const;
  EncoderState state() const;
  // A run is measured from now on.
  void begins(std::int64_t run);
  // Has it counted from one place since the run began? False where nobody knows: that was before
  // this program or before its device was without power. An encoder that does not count is certain.
  bool counts_on_since(std::int64_t run) const;
  // The device that gives the encoder; "": not known before it gave some.
  std::string device() const;

 private:
  std::optional<Notice> missing() const;
  double metres_per(Unit unit) const;
  void watch(double shown_m, std::int64_t time_ns);

  const std::optional<double> um_per_V_;
  mutable std::mutex mutex_;
  EncoderDatum datum_;             // guarded by mutex_
  bool counts_ = false;            // guarded by mutex_
  std::set<std::int64_t> runs_;    // of its present count; guarded by mutex_
  std::string device_;             // guarded by mutex_
  std::optional<double> index_m_;  // where the axis is at its encoder's reference mark
  // What was said last, before this program or since. Guarded by mutex_.
  std::optional<DatumSetting> last_;
  bool since_start_ = false;
  bool found_ = false;  // by find(), and its device has had power since

  // Of the values with their offset, since the axis stopped.
  double rest_m_ = 0, sum_m_ = 0;
  std::uint64_t count_ = 0;
  std::int64_t since_ns_ = 0, last_ns_ = 0;
};

}  // namespace mdof::daemon
