#include "daemon/measure/several_runs/trends_json.h"

#include <algorithm>

#include "daemon/words/words.h"
#include "schema/notice/notice_json.h"
#include "schema/sample.h"
#include "schema/uncertainty/budget_json.h"
#include "schema/uncertainty/run_uncertainty.h"
#include "schema/units.h"

namespace mdof::daemon {

std::string trend_signal(const algo::Chart& chart, std::size_t i) {
  const auto has = [i](const std::vector<std::size_t>& of) {
    return std::find(of.begin(), of.end(), i) != of.end();
  };
  if (has(chart.outside)) return "outside";
  return has(chart.one_side) ? "8 on one side" : "";
}

void write_trend(JsonWriter& json, const Trend& trend) {
  const auto& chart = trend.chart;
  json.key("values").begin_array();
  for (std::size_t i = 0; i < trend.values.size(); ++i) {
    const auto& v = trend.values[i];
    json.begin_object().key("runs").begin_array();
    for (const std::int64_t run : v.runs) json.value(run);
    json.end_array().field("started_utc", v.started_utc);
    write_stated_members(json, v.stated);
    json.field("low", chart ? to_key_unit(chart->low[i]) : kNaN)
        .field("high", chart ? to_key_unit(chart->high[i]) : kNaN)
        .field("signal", chart ? trend_signal(*chart, i) : "")
        .end_object();
  }
  json.end_array()
      .field("centre", chart ? to_key_unit(chart->centre) : kNaN)
      .field("sigma", chart ? to_key_unit(chart->sigma) : kNaN)
      .field("baseline", static_cast<std::uint64_t>(chart ? chart->baseline : 0))
      .key("moved");
  if (chart && chart->moved) {
    json.begin_object().key("since_runs").begin_array();
    for (const std::int64_t run : trend.values[chart->moved->since].runs) json.value(run);
    json.end_array()
        .field("by", to_key_unit(chart->moved->by))
        .field("u_by", to_key_unit(chart->moved->u))
        .end_object();
  } else {
    json.null();
  }
  write_covers(json, covers_text(trend.u_covers), trend.u_not_declared);
  json.key("left_out").begin_array();
  for (const std::string& why : trend.left_out) json.value(why);
  json.end_array();
  write_notices(json, "notices", trend.notices, words::text);
}

std::string trends_json(const std::vector<Trend>& trends) {
  JsonWriter json;
  json.begin_object().field("reference", "fixture").key("figures").begin_object();
  for (const Trend& trend : trends) {
    json.key(trend.figure).begin_object();
    write_trend(json, trend);
    json.end_object();
  }
  json.end_object().end_object();
  return json.take();
}

}  // namespace mdof::daemon
