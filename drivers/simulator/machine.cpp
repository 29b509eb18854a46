#include "drivers/simulator/machine.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <utility>

#include "drivers/simulator/raw_reading.h"
#include "schema/base/random.h"
#include "schema/units.h"

namespace mdof::drivers {
namespace {

// Random sequences; each sequence has its own word in the Philox counter.
enum Stream : std::uint32_t { kValue = 1, kSaturation = 2, kGap = 3 };

Philox draw(std::int64_t seed, Stream stream, std::size_t channel, std::uint64_t index) {
  return philox({static_cast<std::uint32_t>(index), static_cast<std::uint32_t>(index >> 32),
                 static_cast<std::uint32_t>(channel), stream},
                static_cast<std::uint64_t>(seed));
}

bool in_burst(const Bursts& bursts, std::int64_t seed, Stream stream, std::size_t channel,
              std::int64_t t_ns) {
  if (bursts.probability <= 0) return false;
  const auto window = static_cast<std::uint64_t>(ns_to_s(t_ns) / bursts.length_s);
  const Philox random = draw(seed, stream, channel, window);
  return uniform(random[0], random[1]) < bursts.probability;
}

// Error in m or rad. The factor from µm or µrad is the same.
double value_of(const NamedError& error, double travel_m, int direction) {
  const double d_mm = to_mm(travel_m);
  const double wave = sine_of_turns(d_mm / error.period_mm + error.phase_turns);
  const double reversal = (direction > 0 ? error.reversal : -error.reversal) / 2;
  return from_um(error.amplitude * wave + error.slope_per_mm * d_mm + reversal);
}

}  // namespace

Machine::Machine(Rig rig, SimulatorOptions options, ForwardModel model)
    : rig_(std::move(rig)),
      options_(std::move(options)),
      model_(std::move(model)),
      motion_(options_),
      probe_m_(rig_.probes.size()) {
  assert(model_ && options_.errors.size() == kErrorCount);
}

std::vector<Channel> Machine::channels() const {
  std::vector<Channel> channels;
  for (const Probe& probe : rig_.probes) channels.push_back({probe.id, Unit::um});
  channels.push_back({kEncoderChannel, Unit::mm});
  return channels;
}

void Machine::append_scan(SampleBlock& block, std::uint64_t scan, std::int64_t t_ns) {
  const AxisState state = motion_.at(t_ns);
  model_(rig_.sides.target_travel_m(state.travel_m), truth_at(state.travel_m, state.direction),
         probe_m_);
  for (std::size_t k = 0; k < probe_m_.size(); ++k) {
    const Reading reading = probe_reading(k, scan, t_ns, probe_m_[k]);
    block.value[k].push_back(reading.um);
    block.quality[k].push_back(reading.quality);
  }
  block.value.back().push_back(encoder_mm(scan, state.travel_m));
  block.quality.back().push_back(Quality::simulated);
}

bool Machine::in_gap(std::int64_t t_ns) const {
  return in_burst(options_.gap, options_.seed, kGap, 0, t_ns);
}

Errors5 Machine::truth_at(double travel_m, int direction) const {
  Errors5 named{};
  for (std::size_t i = 0; i < named.size(); ++i)
    named[i] = value_of(options_.errors[i], travel_m, direction);
  return local_from_named(rig_.moving(), named);
}

Machine::Reading Machine::probe_reading(std::size_t probe, std::uint64_t scan, std::int64_t t_ns,
                                        double displacement_m) const {
  if (is_lost(probe, t_ns)) return {kNaN, Quality::missing};
  if (in_burst(options_.saturation, options_.seed, kSaturation, probe, t_ns))
    return {end_of_range_um(rig_.probes[probe]), Quality::over_range};
  const Philox random = draw(options_.seed, kValue, probe, scan);
  double disturbance_um = options_.noise_um * gaussian(uniform(random[0], random[1]));
  if (random[2] * 0x1p-32 < options_.spike_probability)
    disturbance_um += random[3] % 2 ? options_.spike_um : -options_.spike_um;
  const RawReading raw = raw_reading(rig_.probes[probe], displacement_m + from_um(disturbance_um));
  return {raw.um, raw.over_range ? Quality::over_range : Quality::simulated};
}

double Machine::encoder_mm(std::uint64_t scan, double travel_m) const {
  const Philox random = draw(options_.seed, kValue, rig_.probes.size(), scan);
  const double noise_nm = options_.encoder_noise_nm * gaussian(uniform(random[0], random[1]));
  const double reading_mm = to_mm(travel_m) + noise_nm * 1e-6;
  const double step_mm = options_.encoder_resolution_nm * 1e-6;
  return step_mm > 0 ? std::floor(reading_mm / step_mm + 0.5) * step_mm : reading_mm;
}

bool Machine::is_lost(std::size_t probe, std::int64_t t_ns) const {
  return std::any_of(options_.lost.begin(), options_.lost.end(), [&](const LostProbe& lost) {
    return lost.probe == rig_.probes[probe].id && lost.when.holds(t_ns);
  });
}

}  // namespace mdof::drivers
