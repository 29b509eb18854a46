#include "daemon/measure/analysis/stored_drift.h"

#include <cmath>

#include "algo/iso230/straightness.h"
#include "algo/model/restate.h"
#include "schema/run_json.h"
#include "schema/units.h"

namespace mdof::daemon {
namespace {

void write_series(JsonWriter& json, const algo::SeriesDrift& drift, double sign) {
  json.begin_object()
      .field("order", drift.order)
      .field("change", drift.significant() ? to_key_unit(sign * drift.change) : std::nan(""))
      .field("u_change", drift.significant() ? to_key_unit(drift.u_change) : std::nan(""))
      .field("range", drift.significant() ? to_key_unit(drift.range) : std::nan(""))
      .field("seen_from", to_key_unit(drift.least_found))
      .field("steps", drift.steps)
      .end_object();
}

void write_closures(JsonWriter& json, const Run& run, const std::vector<algo::Closure>& closures) {
  json.begin_array();
  for (const algo::Closure& c : closures) {
    const Errors5 change = named_from_local(run.header.moving(), c.change);
    json.begin_object()
        .field("run", c.run)
        .field("after_s", c.after_s)
        .field("same_side", c.same_side);
    for (std::size_t k = 0; k < kErrorCount; ++k)
      json.field(error_names(run.header.axis)[k].key, to_key_unit(change[k]));
    json.end_object();
  }
  json.end_array();
}

}  // namespace

StoredDrift drift_of(const Run& run) {
  const Run at_fixture = algo::restate(run, kAtFixture);
  const algo::DriftOfRun drift(at_fixture.points);
  StoredDrift out{drift.found(), {}};
  if (out.found.removable())
    out.without = algo::straightness(run.header.moving(), drift.without(at_fixture.points));
  return out;
}

void write_drift(JsonWriter& json, const Run& run, const std::vector<std::string>& probes,
                 const StoredDrift& drift) {
  const algo::RunDrift& found = drift.found;
  json.begin_object().field("significant", found.significant()).key("not_seen");
  found.not_seen.empty() ? json.null() : json.value(found.not_seen);
  json.field("length_s", found.length_s).field("level", algo::kDriftLevel);
  json.key("errors").begin_object();
  const Errors5 signs = named_from_local(run.header.moving(), Errors5{1, 1, 1, 1, 1});
  const auto& names = error_names(run.header.axis);
  for (std::size_t k = 0; k < kErrorCount && found.not_seen.empty(); ++k) {
    json.key(names[k].key);
    write_series(json, found.errors[names[k].local], signs[k]);
  }
  json.end_object().key("probes").begin_object();
  for (std::size_t k = 0; k < found.probes.size() && k < probes.size(); ++k) {
    json.key(probes[k] + "_um");
    write_series(json, found.probes[k], 1);
  }
  json.end_object().key("closures");
  write_closures(json, run, found.closures);
  json.key("straightness_without");
  write_straightness(json, drift.without);
  json.end_object();
}

}  // namespace mdof::daemon
