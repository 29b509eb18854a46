// Reads the points of a run in pages, for the method run.points.
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

// Used on the thread "query" only. u of a point depends on all points of the run. The object
// therefore keeps u of the run that was requested last.
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
