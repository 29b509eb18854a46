#include "daemon/station/live_json.h"

#include <algorithm>
#include <cmath>

#include "schema/units.h"

namespace mdof::daemon {

void write_clock(JsonWriter& json, const std::optional<drivers::ClockState>& clock) {
  if (!clock) {
    json.null();
    return;
  }
  json.begin_object()
      .field("drift_ppm", clock->drift_ppm)
      .field("jitter_ms", static_cast<double>(clock->jitter_ns) * 1e-6)
      .field("settled", clock->settled)
      .field("steps", clock->steps)
      .end_object();
}

std::string device_json(const DeviceStatus& s) {
  const double rate_hz = s.info.rate_hz > 0 ? s.info.rate_hz : s.measured_hz;
  JsonWriter json;
  json.begin_object()
      .field("device", s.info.name)
      .field("driver", s.info.driver)
      .field("description", s.info.description)
      .field("state", s.state)
      .field("simulated", s.info.simulated)
      .field("rate_hz", rate_hz > 0 ? rate_hz : kNaN)
      .field("scans", s.scans)
      .field("scans_lost", s.lost)
      .field("blocks_dropped", s.dropped)
      .field("reopened", s.reopened);
  json.key("error");
  s.error.empty() ? json.null() : json.value(s.error);
  json.key("last_error");
  s.last_error.empty() ? json.null() : json.value(s.last_error);
  json.key("mended_utc");
  s.recovered_utc.empty() ? json.null() : json.value(s.recovered_utc);
  json.key("trouble").begin_array();
  for (const auto& trouble : s.standing) json.value(trouble_line(trouble));
  json.end_array().key("clock");
  write_clock(json, s.info.clock);
  json.key("channels").begin_array();
  for (const auto& channel : s.info.channels) {
    json.begin_object().field("id", channel.id).field("unit", suffix(channel.unit)).end_object();
  }
  json.end_array().end_object();
  return json.take();
}

std::string devices_json(const std::vector<DeviceStatus>& devices) {
  JsonWriter json;
  json.begin_array();
  for (const auto& device : devices) json.raw(device_json(device));
  json.end_array();
  return json.take();
}

namespace {

// The quality of each reading, also if the position is unknown: a user adjusts the probes before
// the encoder works. A frozen probe has no present reading; its device cannot know this.
std::vector<Quality> qualities(const Pipeline& pipeline, std::size_t probes) {
  std::vector<Quality> all;
  for (std::size_t k = 0; k < probes; ++k)
    all.push_back(std::isnan(pipeline.newest().probe_m[k][0]) ? Quality::missing
                                                              : pipeline.newest_quality()[k]);
  for (const algo::FrozenProbe& frozen : pipeline.frozen_now())
    all[frozen.probe] =
        std::max(all[frozen.probe], frozen.at_limit ? Quality::over_range : Quality::suspect);
  return all;
}

void write_errors(JsonWriter& json, const Rig& rig, const Pipeline& pipeline,
                  const std::vector<Quality>& quality) {
  const FrameBlock& now = pipeline.newest();
  if (!usable(pipeline.newest_quality().back())) {
    json.null();
    return;
  }
  std::vector<double> readings;
  for (std::size_t k = 0; k < rig.probes.size(); ++k)
    readings.push_back(usable(quality[k]) ? now.probe_m[k][0] : kNaN);
  const AxisErrors errors = pipeline.solve_at(now.encoder_m[0], readings, {});
  if (!errors.valid) {
    json.null();
    return;
  }
  const Errors5 named = named_from_local(rig.moving(), errors.local);
  json.begin_object();
  for (std::size_t k = 0; k < 5; ++k) {
    json.field(error_names(rig.axis)[k].key, to_key_unit(named[k]));
  }
  json.end_object();
}

}  // namespace

std::string live_json(const Rig& rig, const Pipeline& pipeline, const RecentRange& recent,
                      const LiveState& state) {
  const FrameBlock& now = pipeline.newest();
  const std::vector<Quality> quality = qualities(pipeline, rig.probes.size());
  const auto stale = [&](Quality q) { return state.stale ? std::max(q, Quality::stale) : q; };
  const Quality encoder =
      stale(std::isnan(now.encoder_m[0]) ? Quality::missing : pipeline.newest_quality().back());
  JsonWriter json;
  json.begin_object()
      .field("axis", std::string(1, letter(rig.axis)))
      .field("time_ns", now.time_ns[0])
      .field("encoder_mm", to_mm(now.encoder_m[0]))
      .field("encoder_quality", to_string(encoder))
      .key("still");
  std::isnan(now.encoder_m[0]) ? json.null() : json.value(pipeline.still());
  json.field("simulated", state.simulated).field("stale", state.stale).field("age_s", state.age_s);
  json.key("waiting_for");
  const auto waiting = pipeline.waiting_for();
  waiting ? json.value(*waiting) : json.null();
  json.key("probes").begin_array();
  for (std::size_t k = 0; k < rig.probes.size(); ++k) {
    const RecentRange::Range range = recent.of(k);
    json.begin_object()
        .field("id", rig.probes[k].id)
        .field("um", to_um(now.probe_m[k][0]))
        .field("low_um", to_um(range.low_m))
        .field("high_um", to_um(range.high_m))
        .field("quality", to_string(stale(quality[k])))
        .field("range_um", to_um(rig.probes[k].range_m))
        .end_object();
  }
  json.end_array();
  json.field("reference", to_string(Reference::fixture)).key("errors");
  state.stale ? void(json.null()) : write_errors(json, rig, pipeline, quality);
  json.key("run");
  state.run > 0 ? json.value(state.run) : json.null();
  json.key("trouble").begin_array();
  for (const auto& line : state.trouble) json.value(line);
  json.end_array().end_object();
  return json.take();
}

}  // namespace mdof::daemon
