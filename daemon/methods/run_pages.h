// The points of a run in pages, for run.points.
#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include "daemon/rpc/params/list_page.h"
#include "daemon/store/store.h"
#include "schema/base/result.h"
#include "schema/rig/reference.h"
#include "schema/run.h"
#include "schema/uncertainty/run_uncertainty.h"

namespace mdof::daemon {

// Runs on the thread "query". u of a point needs all points of its run, so u of the run of the last
// call is kept.
class RunPages {
 public:
  Result<std::string> points(store::Store& store, std::int64_t id, rpc::ListPage page,
                             Reference reference);

 private:
  struct Known {
    std::int64_t points = 0;
    Reference reference = Reference::fixture;
    RunHeader header;
    RunUncertainty uncertainty;
  };
  Status look_at(store::Store& store, std::int64_t id, std::int64_t points, Reference reference);

  std::optional<Known> known_;
};

}  // namespace mdof::daemon
