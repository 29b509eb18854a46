#include "daemon/methods/run_pages.h"

#include <utility>

#include "algo/uncertainty/run_uncertainty.h"
#include "daemon/measure/budgets.h"
#include "daemon/measure/evaluation.h"
#include "daemon/measure/imported/imported_run.h"
#include "schema/base/json_page.h"
#include "schema/imported/imported_json.h"
#include "schema/run_json.h"

namespace mdof::daemon {

namespace {

// restated_points() returns the first point of the run, then the page.
constexpr std::size_t kAfterFirst = 1;

// `run`: result of restated_points().
std::string imported_page(const Run& run, std::int64_t total, std::int64_t offset) {
  const std::string key = imported_run_error(run.header).key();
  JsonWriter json;
  json.begin_object()
      .field("run", run.header.id)
      .field("axis", std::string(1, letter(run.header.axis)))
      .field("total", total)
      .field("offset", offset);
  const Covers covers = readings_coverage(run);
  write_covers(json, covers_text(covers), {});
  json.key("points").begin_array();
  append_page_by_index(json, kAfterFirst, run.points.size(), [&](std::size_t j) {
    JsonWriter item;
    write_imported_point(item, run.points[j], key);
    return item.take();
  });
  json.end_array().end_object();
  return json.take();
}

}  // namespace

Status RunPages::look_at(store::Store& store, std::int64_t id, std::int64_t points,
                         Reference reference) {
  MDOF_TRY(RunHeader header, store.run_header(id));
  const auto is_same = [&](const RunHeader& other) {
    return other.id == id && other.state == header.state &&
           other.started_utc == header.started_utc &&
           other.provenance.recording_sha256 == header.provenance.recording_sha256 &&
           other.provenance.rig_text == header.provenance.rig_text;
  };
  if (known_ && known_->points == points && known_->reference == reference &&
      is_same(known_->header))
    return {};
  MDOF_TRY(const Run whole, restated_run(store, id, reference));
  known_ = Known{points, reference, std::move(header), uncertainty_of(whole)};
  return {};
}

Result<std::string> RunPages::points(store::Store& store, std::int64_t id, rpc::ListPage page,
                                     Reference reference) {
  MDOF_TRY(const auto total, store.count_points(id));
  MDOF_TRY(const Run run, restated_points(store, id, page.offset, page.count, reference));
  if (is_imported(run.header)) return imported_page(run, total, page.offset);
  const bool is_long = total > static_cast<std::int64_t>(algo::kRepeatabilityPointLimit);
  RunUncertainty of_page;
  if (is_long)
    of_page = stop_uncertainty(run);
  else
    MDOF_CHECK(look_at(store, id, total, reference));
  const RunUncertainty& uncertainty = is_long ? of_page : known_->uncertainty;
  const auto row = is_long ? 0 : static_cast<std::size_t>(page.offset) - kAfterFirst;
  JsonWriter json;
  json.begin_object()
      .field("run", id)
      .field("axis", std::string(1, letter(run.header.axis)))
      .field("total", total)
      .field("offset", page.offset);
  write_reference(json, run.header.stated);
  write_covers(json, uncertainty);
  json.key("points").begin_array();
  append_page_by_index(json, kAfterFirst, run.points.size(), [&](std::size_t j) {
    JsonWriter item;
    write_point(item, run.header.moving(), run.points[j], uncertainty.points[row + j]);
    return item.take();
  });
  json.end_array().end_object();
  return json.take();
}

}  // namespace mdof::daemon
