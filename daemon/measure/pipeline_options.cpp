#include "daemon/measure/pipeline_options.h"

#include <cmath>

#include "schema/base/json_writer.h"
#include "schema/units.h"

namespace mdof::daemon {
namespace {

void write_by_channel(JsonWriter& json, const char* key,
                      const std::map<std::string, double>& numbers) {
  if (numbers.empty()) return;
  json.key(key).begin_object();
  for (const auto& [channel, x] : numbers) json.field(channel, x);
  json.end_object();
}

// The offset in mm. Below one kilometre it is rounded to 1 pm, so that the number does not change
// when the text is read and written again.
double offset_mm(const EncoderDatum& datum) {
  const double whole_mm = to_mm(datum.offset_m);
  return std::abs(whole_mm) < 1e6 ? std::round(whole_mm * 1e9) / 1e9 : whole_mm;
}

// Writes nothing for an absolute encoder, because it needs no datum.
void write_datum(JsonWriter& json, const EncoderDatum& datum) {
  if (datum == EncoderDatum()) return;
  json.key("encoder_datum")
      .begin_object()
      .field("kind", to_string(datum.kind))
      .field("offset_mm", offset_mm(datum))
      .field("device", datum.device);
  if (!datum.utc.empty() || !datum.by.empty()) json.field("utc", datum.utc).field("by", datum.by);
  json.end_object();
}

}  // namespace

std::string PipelineOptions::json() const {
  JsonWriter json;
  json.begin_object().field("model", to_string(model));
  json.key("align")
      .begin_object()
      .field("lag_bound_s", align.lag_bound_s)
      .field("max_gap_s", align.max_gap_s);
  write_by_channel(json, "interval_s", align.interval_s);
  write_by_channel(json, "delay_s", align.delay_s);
  json.end_object();
  json.key("dwell").raw(dwell.json());
  json.key("targets_mm").begin_array();
  for (const double t : sequence.targets_m) json.value(to_mm(t));
  json.end_array()
      .field("target_window_mm", to_mm(sequence.target_window_m))
      .field("repeats", repeats);
  if (remove_drift) json.field("remove_drift", true);
  if (on_the_fly) json.key("on_the_fly").raw(on_the_fly->json());
  write_datum(json, datum);
  json.end_object();
  return json.take();
}

std::string PipelineOptions::settings_json() const {
  PipelineOptions o = *this;
  o.align.interval_s.clear();  // the devices state the intervals, not the configuration
  o.sequence.targets_m.clear();
  o.repeats = 0;
  o.datum = {};
  return o.json();
}

}  // namespace mdof::daemon
