#include "daemon/measure/replay/replay_document.h"

#include "daemon/run_item.h"
#include "daemon/words/words.h"
#include "schema/base/json_page.h"
#include "schema/run_json.h"

namespace mdof::daemon {
namespace {

// If the matrix n_ij (plausibility.h) has more values, the reply does not contain the matrix.
constexpr std::size_t kMostVisits = 1500;

std::string document(const RunMembers& members) {
  JsonWriter json;
  json.begin_object();
  write_run_members(json, members, words::text);
  return json.end_object().take();
}

}  // namespace

std::string replay_document(const Run& run, const StatedRun& stated) {
  return document({run, run.header, stated.points, stated.figures});
}

std::string replay_reply(const Run& run, const StatedRun& stated) {
  std::string whole =
      document({run, run.header, stated.points, stated.figures, false, kMostVisits});
  if (whole.size() <= kPageBytes) return whole;
  return document({run, shortened(run.header), stated.points, stated.figures, false, 0});
}

}  // namespace mdof::daemon
