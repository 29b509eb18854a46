#include "daemon/measure/analysis/analysis.h"

#include <vector>

#include "algo/iso230/straightness.h"
#include "daemon/measure/analysis/stored_drift.h"
#include "daemon/measure/budgets.h"
#include "daemon/measure/evaluation.h"
#include "schema/imported/series.h"
#include "schema/iso230/iso230_json.h"
#include "schema/run_json.h"
#include "schema/uncertainty/budget_json.h"

namespace mdof::daemon {

Result<std::string> analysis_document(store::Store& store, const Run& run) {
  MDOF_CHECK(check_measured(run.header, "an analysis"));
  MDOF_TRY(const Rig rig, rig_of(run.header));
  std::vector<std::string> probes;
  for (const Probe& probe : rig.probes) probes.push_back(probe.id);
  MDOF_TRY(const auto by, store.superseded_by(run.header.id));
  JsonWriter json;
  json.begin_object()
      .field("run", run.header.id)
      .field("axis", std::string(1, letter(run.header.axis)))
      .field("model", run.header.provenance.model)
      .field("simulated", run.header.simulated)
      .key("superseded_by");
  by ? json.value(*by) : json.null();
  write_reference(json, run.header.stated);
  const StatedFigures stated = figure_budgets(run);
  write_covers(json, stated.budgets);
  json.key("straightness");
  write_straightness(json, run.straightness, stated.budgets);
  json.key("straightness_lines");
  write_straightness_lines(json, algo::straightness_lines(run.header.moving(), run.points));
  json.key("angles");
  write_angles(json, run.angles);
  write_stated(json, stated);
  json.key("drift");
  write_drift(json, run, probes, drift_of(run));
  return json.end_object().take();
}

}  // namespace mdof::daemon
