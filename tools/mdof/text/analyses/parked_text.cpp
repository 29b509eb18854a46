#include "tools/mdof/text/analyses/parked_text.h"

#include <cmath>

#include "daemon/words/words.h"
#include "schema/run_json.h"
#include "schema/units.h"
#include "tools/mdof/text/run_tables.h"
#include "tools/mdof/text/text_table.h"

namespace mdof::tools {
namespace {

constexpr double kMinute_s = 60, kHour_s = 3600;
constexpr double kPerHour = 3600e9;  // nm/h per m/s

bool is_angle(const daemon::ParkedLog& log, std::size_t series) {
  return series >= log.probes && error_names(log.axis)[series - log.probes].angle;
}

// A drift rate (m/s or rad/s) in nm/h for a length, in urad/h for an angle.
double shown(const daemon::ParkedLog& log, std::size_t series, double per_s) {
  return is_angle(log, series) ? to_urad(per_s) * kHour_s : per_s * kPerHour;
}

std::string minutes(double s) {
  return fixed(s / kMinute_s, 1);
}

std::string head_of(const daemon::ParkedLog& log, std::size_t series) {
  const std::string& name = log.readings.series[series].name;
  return name.substr(0, name.find('_')) + (is_angle(log, series) ? "/(µrad/h)" : "/(nm/h)");
}

std::string mark_of(algo::DriftVerdict verdict) {
  if (verdict == algo::DriftVerdict::above) return " !";
  return verdict == algo::DriftVerdict::undecided ? " ?" : "";
}

std::string rates_text(const daemon::ParkedLog& log, const algo::WarmUp& found, std::size_t begin,
                       std::size_t end, std::size_t width) {
  std::vector<std::string> head{"from/min"};
  for (std::size_t s = begin; s < end; ++s) head.push_back(head_of(log, s));
  TextTable table(std::move(head));
  for (std::size_t w = 0; w < found.begin_s.size(); ++w) {
    std::vector<std::string> row{minutes(found.begin_s[w])};
    for (std::size_t s = begin; s < end; ++s) {
      const algo::DriftWindow& window = found.windows[s][w];
      row.push_back(std::isnan(window.rate_per_s) ? "-"
                                                  : with_u(shown(log, s, window.rate_per_s),
                                                           shown(log, s, window.u_rate_per_s), 1) +
                                                        mark_of(window.verdict));
    }
    table.add(std::move(row));
  }
  return table.text(width);
}

std::string temperature_text(const daemon::ParkedLog& log, const algo::WarmUp& found,
                             std::size_t width) {
  if (found.with_temperature.empty())
    return "the log has no column \"temperature_C\", so the drift with temperature is unknown\n";
  TextTable table({"drift with temperature", "per °C", "correlation"});
  for (std::size_t s = 0; s < found.with_temperature.size(); ++s) {
    const auto& with = found.with_temperature[s];
    const std::string& name = log.readings.series[s].name;
    table.add({name.substr(0, name.find('_')),
               fixed(is_angle(log, s) ? to_urad(with.slope_per_K) : with.slope_per_K * 1e9, 1) +
                   (is_angle(log, s) ? " µrad" : " nm"),
               fixed(with.correlation, 3)});
  }
  return table.text(width);
}

// Why the system is not ready: the series that exceeds its limit most in the last time window, or a
// series whose drift is unknown.
std::string not_ready_reason(const daemon::ParkedLog& log, const algo::WarmUp& found) {
  std::string worst;
  double most = 0;
  for (std::size_t s = 0; s < found.windows.size(); ++s) {
    const double limit = log.readings.series[s].limit_per_s;
    if (std::isinf(limit)) continue;
    const algo::DriftWindow& last = found.windows[s].back();
    if (last.verdict == algo::DriftVerdict::below) continue;
    if (std::isnan(last.rate_per_s))
      return log.readings.series[s].name + " has no readings in the last window";
    if (last.verdict == algo::DriftVerdict::unknown)
      return log.readings.series[s].name +
             " does not change in the whole log; check the probe, the cable and the resolution";
    const double by = (std::abs(last.rate_per_s) + 2 * last.u_rate_per_s) / limit;
    if (by <= most) continue;
    most = by;
    worst = "in the last window " + head_of(log, s).substr(0, head_of(log, s).find('/')) +
            " drifts by " +
            with_u(shown(log, s, last.rate_per_s), shown(log, s, last.u_rate_per_s), 1) +
            (is_angle(log, s) ? " µrad/h" : " nm/h") +
            (last.verdict == algo::DriftVerdict::undecided
                 ? ", which is too uncertain to decide; use longer windows (--window-s)"
                 : "");
  }
  return worst;
}

}  // namespace

std::string parked_verdict(const daemon::ParkedLog& log, const algo::WarmUp& found) {
  if (!found.limited)
    return "no limit is given, so mdof cannot decide when the system is ready; give "
           "--limit-nm-per-h, or [drift] limit_um_per_h in the rig";
  if (found.ready_after_s)
    return "ready after " + minutes(*found.ready_after_s) +
           " min: after this time, the drift is below the limit in every window";
  const std::string what = not_ready_reason(log, found);
  return "not ready yet: " +
         (what.empty() ? "at the end of the log, at least " + std::to_string(algo::kFewestBelow) +
                             " windows (together at least " + minutes(algo::kShortestBelow_s) +
                             " min) must be below the limit; record a longer log"
                       : what);
}

std::string parked_text(const daemon::ParkedLog& log, const algo::WarmUp& found,
                        std::size_t width) {
  std::string out = noise_only_notice(!log.declares) + simulated_notice(log.simulated);
  out += "axis " + std::string(1, letter(log.axis)) + " parked at " + in_mm(log.position_m) +
         " mm, " + minutes(log.length_s) + " min, windows of " + minutes(found.window_s) + " min";
  if (log.limit_m_per_s) out += ", limit " + fixed(*log.limit_m_per_s * kPerHour, 1) + " nm/h";
  out += "\n\n" + rates_text(log, found, 0, log.probes, width) + "\n" +
         rates_text(log, found, log.probes, log.readings.series.size(), width);
  out += "± is the standard uncertainty u. It contains the noise of the readings only\n";
  if (found.limited)
    out += "!: above the limit; ?: within two standard uncertainties of the limit\n";
  return out + "\n" + temperature_text(log, found, width) + "\n" +
         wrapped(parked_verdict(log, found), width) + "\n";
}

namespace {

void write_series(JsonWriter& json, const daemon::ParkedLog& log, const algo::WarmUp& found,
                  std::size_t s) {
  const bool angle = is_angle(log, s);
  const auto& series = log.readings.series[s];
  json.begin_object().field(angle ? "limit_urad_per_h" : "limit_nm_per_h",
                            shown(log, s, series.limit_per_s));
  if (!found.with_temperature.empty())
    json.field(angle ? "urad_per_K" : "nm_per_K",
               (angle ? 1e6 : 1e9) * found.with_temperature[s].slope_per_K)
        .field("correlation_with_temperature", found.with_temperature[s].correlation);
  json.key("windows").begin_array();
  for (const algo::DriftWindow& w : found.windows[s])
    json.begin_object()
        .field(angle ? "rate_urad_per_h" : "rate_nm_per_h", shown(log, s, w.rate_per_s))
        .field(angle ? "u_rate_urad_per_h" : "u_rate_nm_per_h", shown(log, s, w.u_rate_per_s))
        .field("verdict", to_string(w.verdict))
        .end_object();
  json.end_array().end_object();
}

}  // namespace

std::string parked_json(const daemon::ParkedLog& log, const algo::WarmUp& found) {
  JsonWriter json;
  json.begin_object()
      .field("axis", std::string_view(std::string(1, letter(log.axis))))
      .field("simulated", log.simulated)
      .field("u_covers", "noise of the readings only")
      .field("noise_only", !log.declares)
      .field("position_mm", to_mm(log.position_m))
      .field("length_s", log.length_s)
      .field("window_s", found.window_s)
      .key("begin_s")
      .begin_array();
  for (const double s : found.begin_s) json.value(s);
  json.end_array().key("ready");
  found.limited ? json.value(found.ready_after_s.has_value()) : json.null();
  json.field("ready_after_s", found.ready_after_s.value_or(std::nan("")))
      .field("says", parked_verdict(log, found))
      .key("series")
      .begin_object();
  for (std::size_t s = 0; s < log.readings.series.size(); ++s) {
    const std::string& name = log.readings.series[s].name;
    json.key(name.substr(0, name.find('_')));
    write_series(json, log, found, s);
  }
  json.end_object().end_object();
  return with_notices(json.take(), log.notices, words::text);
}

}  // namespace mdof::tools
