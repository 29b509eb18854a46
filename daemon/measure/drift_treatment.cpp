#include "daemon/measure/drift_treatment.h"

#include <utility>

#include "algo/drift/drift_sentences.h"
#include "algo/drift/run_drift.h"

namespace mdof::daemon {

void treat_drift(const Rig& rig, bool remove, Run& run) {
  if (!remove && !rig.drift_limit_m_per_s) return;
  const algo::DriftOfRun drift(run.points);
  append(run.header.notices, algo::over_limit(drift.found(), rig));
  if (rig.drift_limit_m_per_s && !drift.found().not_seen.empty())
    run.header.notes.push_back("the limit of drift was not tested: " + drift.found().not_seen);
  if (!remove) return;
  run.header.notes.push_back(algo::removed_sentence(drift.found(), rig.moving()));
  run.points = drift.without(std::move(run.points));
}

}  // namespace mdof::daemon
