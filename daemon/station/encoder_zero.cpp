#include "daemon/station/encoder_zero.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "daemon/words/words.h"
#include "drivers/clock/monotonic.h"
#include "schema/base/number/number_text.h"
#include "schema/units.h"

namespace mdof::daemon {
namespace {

constexpr int kDigits = 9;        // digits of a length of 1 m in nm
constexpr double kRest_m = 5e-6;  // largest vibration of an axis at rest
constexpr std::int64_t kRest_ns = 200'000'000, kStale_ns = 1'000'000'000;

// The notice that the axis position that a user set last is no longer valid.
Notice position_lost(const DatumSetting& said, bool since_start, const EncoderDatum& now) {
  return notice(NoticeCode::position_lost, std::string(1, letter(said.axis)),
                {{"position_mm", to_mm(said.position_m)},
                 {"utc", said.utc},
                 {"without_power", since_start ? 1 : 0},
                 {"configured", now.kind == EncoderDatum::Kind::configured ? 1 : 0},
                 {"counted", now.kind == EncoderDatum::Kind::none ? 1 : 0}});
}

}  // namespace

EncoderZero::EncoderZero(const std::vector<drivers::DriverSpec>& devices,
                         std::optional<DatumSetting> before, std::optional<double> um_per_V)
    : um_per_V_(um_per_V), last_(std::move(before)) {
  for (const auto& device : devices) {
    const auto& ids = device.channels;
    const bool all = ids.empty();
    if (!all && std::find(ids.begin(), ids.end(), kEncoderChannel) == ids.end()) continue;
    if (!all) device_ = device.name;
    if (device.encoder.counts) {
      counts_ = true;
      datum_.kind = EncoderDatum::Kind::none;
      datum_.device = device.name;
    }
    if (device.encoder.index_mm) index_m_ = from_mm(*device.encoder.index_mm);
    if (!device.encoder.offset_mm) continue;
    datum_ = {EncoderDatum::Kind::configured, from_mm(*device.encoder.offset_mm), device.name, "",
              ""};
  }
}

EncoderDatum EncoderZero::datum() const {
  const std::lock_guard lock(mutex_);
  return datum_;
}

EncoderState EncoderZero::state() const {
  const std::lock_guard lock(mutex_);
  EncoderState state{datum_, missing(), ""};
  if (state.notice)
    state.note = words::text(*state.notice);
  else if (datum_.kind == EncoderDatum::Kind::index)
    state.note = datum_text(datum_);
  else if (last_ && datum_.kind == EncoderDatum::Kind::set)
    state.note = "set to " + plain_number(to_mm(last_->position_m), kDigits) + " mm on " +
                 datum_.utc + " by " + datum_.by;
  return state;
}

std::optional<Notice> EncoderZero::missing() const {
  using Kind = EncoderDatum::Kind;
  if (datum_.kind == Kind::index) return {};
  if (index_m_ && datum_.kind == Kind::none)
    return notice(NoticeCode::reference_mark_not_passed, datum_.device);
  if (last_ && datum_.kind != Kind::set) return position_lost(*last_, since_start_, datum_);
  if (datum_.kind == Kind::none) return notice(NoticeCode::datum_missing, datum_.device);
  return {};
}

std::string EncoderZero::device() const {
  const std::lock_guard lock(mutex_);
  return device_;
}

// Factor from raw values in this unit to metres.
double EncoderZero::metres_per(Unit unit) const {
  switch (unit) {
    case Unit::um:
      return 1e-6;
    case Unit::mm:
      return 1e-3;
    case Unit::metre:
      return 1;
    case Unit::volt:
      return from_um(um_per_V_.value_or(0));
    default:
      return 0;  // the unit is no length; the calibration reports this error
  }
}

void EncoderZero::apply(SampleBlock& block) {
  const auto at = std::find_if(block.channels.begin(), block.channels.end(),
                               [](const Channel& c) { return c.id == kEncoderChannel; });
  if (at == block.channels.end() || block.scans() == 0) return;
  const double m_per_unit = metres_per(at->unit);
  if (m_per_unit == 0) return;
  double offset_m = 0;
  {
    const std::lock_guard lock(mutex_);
    offset_m = datum_.offset_m;
    if (device_ != block.device) device_ = block.device;
  }
  auto& values = block.value[static_cast<std::size_t>(at - block.channels.begin())];
  if (offset_m != 0) {
    const double offset = offset_m / m_per_unit;
    for (double& value : values) value += offset;
  }
  for (std::size_t i = 0; i < values.size(); ++i) watch(values[i] * m_per_unit, block.time_ns[i]);
}

void EncoderZero::watch(double shown_m, std::int64_t time_ns) {
  if (std::isnan(shown_m)) return;
  if (count_ == 0 || !(std::abs(shown_m - rest_m_) <= kRest_m)) {
    rest_m_ = shown_m;
    sum_m_ = 0;
    count_ = 0;
    since_ns_ = time_ns;
  }
  sum_m_ += shown_m - rest_m_;
  ++count_;
  last_ns_ = time_ns;
}

Result<DatumSetting> EncoderZero::find(Axis axis, double position_m, const std::string& utc) {
  if (drivers::monotonic_ns() - last_ns_ > kStale_ns)
    return fail(
        ErrorCode::conflict,
        "the encoder has sent no sample for 1 s, so the present reading of the encoder is unknown",
        Remedy::list_devices);
  if (count_ == 0 || last_ns_ - since_ns_ < kRest_ns)
    return fail(ErrorCode::conflict,
                "the axis moves, or has stood still for less than 0.2 s; stop the axis at a known "
                "position, then set that position");
  const double shown_m = rest_m_ + sum_m_ / static_cast<double>(count_);
  const std::lock_guard lock(mutex_);
  found_ = true;
  return DatumSetting{
      0, axis, device_, shown_m, position_m, datum_.offset_m + (position_m - shown_m), utc};
}

Result<EncoderDatum> EncoderZero::put(const DatumSetting& setting, const std::string& by) {
  const std::lock_guard lock(mutex_);
  if (!std::exchange(found_, false))
    return fail(
        ErrorCode::conflict,
        "device \"" + setting.device +
            "\" has just lost power, or the axis has just passed the reference mark, so the "
            "reading of the encoder is no longer valid; set the position of the axis again");
  datum_ = {EncoderDatum::Kind::set, setting.offset_m, setting.device, setting.utc, by};
  last_ = setting;
  since_start_ = true;
  count_ = 0;
  return datum_;
}

void EncoderZero::begins(std::int64_t run) {
  const std::lock_guard lock(mutex_);
  runs_.insert(run);
}

bool EncoderZero::has_counted_since(std::int64_t run) const {
  const std::lock_guard lock(mutex_);
  return !counts_ || runs_.count(run) > 0;
}

void EncoderZero::lose(const std::string& device) {
  const std::lock_guard lock(mutex_);
  if (device != device_ || datum_.kind == EncoderDatum::Kind::absolute) return;
  runs_.clear();
  counts_ = true;
  found_ = false;
  datum_.offset_m = 0;  // the offset was valid only for the lost count
  datum_.kind = EncoderDatum::Kind::none;
  datum_.device = device;
  datum_.utc = datum_.by = "";
}

bool EncoderZero::pass_mark(const std::string& device, const std::string& utc) {
  const std::lock_guard lock(mutex_);
  if (!index_m_ || (!device_.empty() && device != device_)) return false;
  datum_ = {EncoderDatum::Kind::index, *index_m_, device, utc, ""};
  found_ = false;
  count_ = 0;  // the collected readings have another origin
  return true;
}

}  // namespace mdof::daemon
