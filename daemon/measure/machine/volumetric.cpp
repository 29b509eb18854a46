#include "daemon/measure/machine/volumetric.h"

#include <map>
#include <set>
#include <utility>

#include "daemon/measure/machine/stored_errors.h"
#include "daemon/paths.h"

namespace mdof::daemon {
namespace {

std::string names_of(const std::vector<std::string>& names) {
  std::string text;
  for (const std::string& name : names) text += (text.empty() ? "" : ", ") + name;
  return text;
}

// What the table itself says of its errors.
Notices own_notices(const VolumetricTable& table) {
  Notices own;
  if (!table.not_measured.empty())
    own.push_back(
        notice(NoticeCode::volume_incomplete, "", {{"errors", names_of(table.not_measured)}}));
  if (!table.beyond_tables.empty())
    own.push_back(
        notice(NoticeCode::volume_beyond_tables, "", {{"errors", names_of(table.beyond_tables)}}));
  return own;
}

Result<std::vector<Run>> runs_of(store::Store& store, const VolumetricTable& table) {
  std::vector<Run> runs(table.runs.size());
  for (std::size_t i = 0; i < runs.size(); ++i) {
    MDOF_TRY(runs[i], store.run(table.runs[i]));
  }
  return runs;
}

// Axes whose targets were all approached from one side, and not from that of the table: the errors
// of that side stand for those of the other, so a reversal error is not in the table.
Notices one_sided(const VolumetricTable& table, const std::vector<Run>& runs) {
  std::map<std::pair<Axis, bool>, std::set<std::string>> seen;  // positioning is measured apart
  for (const Run& run : runs)
    for (const MeasuredPoint& p : run.points)
      if (p.point.direction != 0)
        seen[{run.header.axis, is_imported(run.header)}].insert(p.point.direction > 0 ? "forward"
                                                                                      : "reverse");
  Notices found;
  for (const auto& [measured, approaches] : seen)
    if (approaches.size() == 1 && *approaches.begin() != table.approach)
      found.push_back(
          notice(NoticeCode::volume_from_one_side, std::string(1, letter(measured.first)),
                 {{"approach", *approaches.begin()}, {"positioning", measured.second ? 1 : 0}}));
  return found;
}

}  // namespace

Result<BuiltVolumetric> calculate_volumetric(store::Store& store,
                                             const VolumetricTableRequest& request) {
  Machine machine = request.machine;
  MDOF_TRY(StoredErrors stored, take_stored_errors(store, machine));
  BuiltVolumetric built;
  MDOF_TRY(built.table, algo::build_volumetric(machine, request.grid));
  built.table.description = request.description;
  built.table.runs = std::move(stored.runs);
  MDOF_TRY(const std::vector<Run> runs, runs_of(store, built.table));
  built.notices = own_notices(built.table);
  append(built.notices, one_sided(built.table, runs));
  built.doubtful = built.notices;
  append(built.notices, std::move(stored.notices));
  append(built.doubtful, std::move(stored.doubtful));
  return built;
}

Status store_volumetric(store::Store& store, VolumetricTable& table,
                        const std::optional<HistoryEntry>& action) {
  table.created_utc = utc_now();
  table.sha256 = volumetric_sha256(table);
  MDOF_TRY(table.id, store.add_volumetric(table, action));
  return {};
}

Result<Notices> doubtful_notices(store::Store& store, const VolumetricTable& table) {
  Notices found = own_notices(table);
  MDOF_TRY(const std::vector<Run> runs, runs_of(store, table));
  append(found, one_sided(table, runs));
  append(found, doubtful_notices(runs));
  return found;
}

Result<Judged> judged_table(store::Store& store, const VolumetricTable& table) {
  Judged judged{"table " + std::to_string(table.id), table.simulated, {}};
  MDOF_TRY(judged.doubtful, doubtful_notices(store, table));
  return judged;
}

Result<store::Marks> check_volumetric_activation(store::Store& store, std::int64_t id,
                                                 const Consent& consent) {
  MDOF_TRY(const VolumetricTable table, store.volumetric(id));
  for (const Axis axis : {Axis::x, Axis::y, Axis::z}) {
    const auto active = store.active(axis);
    if (!active && active.error().code == ErrorCode::not_found) continue;
    if (!active) return tl::unexpected(active.error());
    return fail(
        ErrorCode::conflict,
        std::string("table ") + std::to_string(active->table.id) + " of axis " + letter(axis) +
            " is active; if a volumetric table were active too, the controller would correct twice",
        Remedy::deactivate_axis, std::string(1, letter(axis)));
  }
  MDOF_TRY(const Judged judged, judged_table(store, table));
  const auto now = store.active_volumetric();
  if (!(now && now->table.id == id)) MDOF_CHECK(check_gate(judged, consent, "it is not activated"));
  return store::Marks{judged.simulated, !judged.doubtful.empty()};
}

Status check_no_volumetric(store::Store& store) {
  const auto active = store.active_volumetric();
  if (!active && active.error().code == ErrorCode::not_found) return {};
  if (!active) return tl::unexpected(active.error());
  return fail(
      ErrorCode::conflict,
      "the volumetric table " + std::to_string(active->table.id) +
          " is active; if the table of an axis were active too, the controller would correct twice",
      Remedy::deactivate_volume);
}

}  // namespace mdof::daemon
