#include "drivers/calibration.h"

#include <algorithm>
#include <cmath>
#include <span>

#include "schema/base/compiled_for.h"
#include "schema/rig/effects/physics.h"
#include "schema/units.h"

namespace mdof::drivers {
namespace {

// Middle part of the range; a reading outside this part is at an end of the range.
constexpr double kRangeUsed = 0.9995;

// Limits of the valid raw readings, µm. A reading at a limit or outside the limits is at an end of
// the range.
struct Window {
  double low_um, high_um;
};
Window valid_window(const Probe& probe) {
  if (const auto& valid = probe.calibration.valid_um) return {(*valid)[0], (*valid)[1]};
  const double range_um = to_um(probe.range_m);
  if (probe.calibration.reads_gap) return {(1 - kRangeUsed) * range_um, kRangeUsed * range_um};
  return {-kRangeUsed * range_um / 2, kRangeUsed * range_um / 2};
}

void mark(SampleBlock& block, std::size_t channel, std::size_t scan, Quality quality) {
  if (block.quality.empty()) block.quality.resize(block.channels.size());
  auto& column = block.quality[channel];
  if (column.empty()) column.assign(block.scans(), Quality::good);
  column[scan] = std::max(column[scan], quality);
}

}  // namespace

double displacement_m(const Calibration& c, double raw_um) {
  const double reading_um = raw_um - c.offset_um;
  const double displacement_um = reading_um + linearity_um(c, reading_um);
  return from_um(c.reads_gap ? -displacement_um : displacement_um);
}

std::array<double, 2> displacement_window_m(const Probe& probe) {
  const Window raw = valid_window(probe);
  const double a_m = displacement_m(probe.calibration, raw.low_um);
  const double b_m = displacement_m(probe.calibration, raw.high_um);
  return {std::min(a_m, b_m), std::max(a_m, b_m)};
}

namespace {

// Converts raw values to displacements. Returns true if a value is outside the window or NaN. The
// loops of these functions have no branches, so that the compiler can use vector instructions.
using Displace = bool (*)(double um_per_unit, Window window, std::span<double> values);

// For a probe that has neither offset, linearity table nor polynomial, and does not read the gap.
[[gnu::always_inline]] inline bool scale(double um_per_unit, Window window,
                                         std::span<double> values) {
  unsigned outside = 0;
  for (double& value : values) {
    const double raw_um = value * um_per_unit;
    outside |= !(raw_um > window.low_um) | !(raw_um < window.high_um);
    value = from_um(raw_um);
  }
  return outside != 0;
}

bool scale_baseline(double um_per_unit, Window window, std::span<double> values) {
  return scale(um_per_unit, window, values);
}
MDOF_AVX2 bool scale_avx2(double um_per_unit, Window window, std::span<double> values) {
  return scale(um_per_unit, window, values);
}
MDOF_AVX512 bool scale_avx512(double um_per_unit, Window window, std::span<double> values) {
  return scale(um_per_unit, window, values);
}
const Displace kScale = has_avx512() ? scale_avx512 : has_avx2() ? scale_avx2 : scale_baseline;

bool displace(const Calibration& c, double um_per_unit, Window window, std::span<double> values) {
  if (c.offset_um == 0.0 && c.linearity.empty() && c.polynomial_um.empty() && !c.reads_gap)
    return kScale(um_per_unit, window, values);
  bool outside = false;
  for (double& value : values) {
    const double raw_um = value * um_per_unit;
    outside |= !(raw_um > window.low_um) || !(raw_um < window.high_um);
    value = displacement_m(c, raw_um);
  }
  return outside;
}

}  // namespace

namespace {

Status reject_encoder(const SampleBlock& block, const Channel& encoder, const std::string& rig) {
  const std::string unit = suffix(encoder.unit);
  const std::string scale =
      encoder.unit == Unit::volt ? "set um_per_V in [encoder] of " + rig + ", or " : "";
  return bad_input(
      (block.device.empty() ? "" : "device \"" + block.device + "\": ") + "channel \"encoder\" " +
      (unit.empty() ? "has no unit" : "is in " + unit) +
      ", but an axis position must be a length; " + scale +
      "use an input in um, in mm or in counts (with the key um_per_count). A CSV column of the "
      "encoder must have the name encoder_mm or encoder_um");
}

}  // namespace

// um_per_V of a record is not used for a channel whose unit is a length.
Notices unused_scales(const Rig& rig, const std::vector<Channel>& channels) {
  Notices found;
  for (const Channel& channel : channels)
    for (const Probe& probe : rig.probes)
      if (channel.id == probe.id && channel.unit != Unit::volt &&
          !probe.calibration.scale_record.empty())
        found.push_back(notice(NoticeCode::scale_not_used, probe.id,
                               {{"record", probe.calibration.scale_record}}));
  return found;
}

Notices unused_channels(const Rig& rig, const std::vector<Channel>& channels) {
  std::string ids;
  for (const Channel& channel : channels) {
    const bool is_auxiliary = channel.unit == Unit::deg_c || channel.unit == Unit::other;
    if (is_auxiliary || channel.id == kEncoderChannel || rig.probe_index(channel.id)) continue;
    ids += (ids.empty() ? "" : ", ") + channel.id;
  }
  if (ids.empty()) return {};
  return {notice(NoticeCode::channels_not_in_rig, "", {{"channels", ids}})};
}

Calibrator::Calibrator(const Rig& rig)
    : encoder_um_per_V_(rig.encoder_um_per_V), rig_source_(rig.source) {
  for (const auto& probe : rig.probes) probes_.emplace(probe.id, probe);
}

Status Calibrator::apply_encoder(std::size_t channel, SampleBlock& block) const {
  const Unit unit = block.channels[channel].unit;
  auto& values = block.value[channel];
  if (unit == Unit::volt && encoder_um_per_V_) {
    for (double& value : values) value = from_um(value * *encoder_um_per_V_);
    return {};
  }
  if (unit != Unit::um && unit != Unit::mm)
    return reject_encoder(block, block.channels[channel], rig_source_);
  const double per_metre = unit == Unit::um ? 1e6 : 1e3;
  for (double& value : values) value /= per_metre;
  return {};
}

Status Calibrator::apply_probe(const Probe& probe, std::size_t channel, SampleBlock& block) const {
  const Unit unit = block.channels[channel].unit;
  const Calibration& c = probe.calibration;
  double um_per_unit = 1.0;
  if (unit == Unit::volt) {
    if (!c.um_per_V) {
      return bad_input(
          rig_source_ + ": probe \"" + probe.id +
          "\" gives volts, but um_per_V is missing; add um_per_V to the [[probe]] of this probe");
    }
    um_per_unit = *c.um_per_V;
  } else if (unit == Unit::mm) {
    um_per_unit = 1e3;
  } else if (unit != Unit::um) {
    return bad_input("channel \"" + probe.id +
                     "\" is a probe of the rig, but the unit of this channel is neither a length "
                     "nor volts; a CSV column of this probe must have the name " +
                     probe.id + "_um or " + probe.id + "_V");
  }
  auto& column = block.value[channel];
  if (!displace(c, um_per_unit, valid_window(probe), column)) return {};
  // This second loop runs only rarely. It compares displacements with the limits, because the raw
  // values are already overwritten.
  const Window window = valid_window(probe);
  const double low_m = displacement_m(c, window.low_um), high_m = displacement_m(c, window.high_um);
  for (std::size_t i = 0; i < column.size(); ++i) {
    if (std::isnan(column[i])) {
      mark(block, channel, i, Quality::missing);
    } else if (column[i] <= std::min(low_m, high_m) || column[i] >= std::max(low_m, high_m)) {
      mark(block, channel, i, Quality::over_range);
    }
  }
  return {};
}

Status Calibrator::apply(SampleBlock& block) const {
  for (std::size_t channel = 0; channel < block.channels.size(); ++channel) {
    const Channel& what = block.channels[channel];
    if (what.unit == Unit::metre) continue;
    if (what.id == kEncoderChannel) {
      MDOF_CHECK(apply_encoder(channel, block));
    } else if (const auto probe = probes_.find(what.id); probe != probes_.end()) {
      MDOF_CHECK(apply_probe(probe->second, channel, block));
    } else {
      continue;
    }
    block.channels[channel].unit = Unit::metre;
  }
  return {};
}

Status Calibrator::check(const std::vector<Channel>& channels) const {
  SampleBlock block;
  block.channels = channels;
  block.time_ns.assign(1, 0);
  block.value.assign(channels.size(), {0.0});
  return apply(block);
}

}  // namespace mdof::drivers
