#include "daemon/measure/drift_treatment.h"

#include <utility>

#include "algo/drift/drift_sentences.h"
#include "algo/drift/run_drift.h"

namespace mdof::daemon {

void treat_drift(const Rig& rig, bool remove, Run& run) {
  const algo::DriftOfRun drift(run.points);
  append(run.header.notices, algo::reversal_notices(drift, run.points, rig.moving(), remove));
  append(run.header.notices, algo::over_limit(drift.found(), rig));
  if (rig.drift_limit_m_per_s && !drift.found().not_seen.empty())
    run.header.notices.push_back(
        notice(NoticeCode::drift_limit_not_tested, "", {{"reason", drift.found().not_seen}}));
  if (!remove) return;
  append(run.header.notices, algo::removal_notices(drift.found(), rig.moving()));
  run.points = drift.without(std::move(run.points));
}

}  // namespace mdof::daemon
