#include "daemon/measure/machine/volumetric.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <set>
#include <utility>

#include "algo/compensation/residual_limits.h"
#include "algo/machine/compensating.h"
#include "daemon/measure/machine/stored_errors.h"
#include "daemon/paths.h"
#include "schema/base/number/number_text.h"
#include "schema/imported/series.h"
#include "schema/units.h"

namespace mdof::daemon {
namespace {

// A corrected command is rounded to this step, so smaller errors have no effect.
constexpr double kStepOfTables_m = 1e-9;

std::string names_of(const std::vector<std::string>& names) {
  std::string text;
  for (const std::string& name : names) text += (text.empty() ? "" : ", ") + name;
  return text;
}

// Notices about the residual error of one command. The residual error has two parts: the reversal
// error and the interpolation error between nodes. The limit is the limit of the self-test of an
// export. If the sum of the two parts exceeds the limit, the larger part gets a doubtful notice.
// The smaller part gets a doubtful notice if this part alone exceeds the limit.
Notices residual_notices(const VolumetricTable& table, std::size_t k) {
  const std::string command(1, "XYZ"[k]);
  const double reversal = table.reversal_m[k], between = table.interpolation_m[k];
  const double largest = algo::largest_correction_m(table, k);
  const double limit = algo::ResidualLimits{}.of(largest + reversal, kStepOfTables_m);
  const auto too_large = [&](double part, double other) {
    return part > limit || (part + other > limit && part >= other);
  };
  Notices left;
  if (too_large(reversal, between) && table.approach != "mean")
    left.push_back(notice(NoticeCode::volume_one_approach, command,
                          {{"left_um", to_um(reversal)}, {"approach", table.approach}}));
  else if (too_large(reversal, between))
    left.push_back(notice(NoticeCode::volume_reversal, command,
                          {{"left_um", to_um(reversal)},
                           {"limit_um", to_um(limit)},
                           {"largest_um", to_um(largest)},
                           {"approach", table.approach}}));
  else if (reversal > kStepOfTables_m)
    left.push_back(notice(
        NoticeCode::volume_reversal_small, command,
        {{"left_um", to_um(reversal)}, {"limit_um", to_um(limit)}, {"approach", table.approach}}));
  if (too_large(between, reversal))
    left.push_back(notice(
        NoticeCode::volume_between_nodes, command,
        {{"left_um", to_um(between)}, {"limit_um", to_um(limit)}, {"largest_um", to_um(largest)}}));
  return left;
}

// Text of a direction: "Z", "0.866 X + 0.5 Z". The sign of the direction has no meaning, so the
// first number is always positive.
std::string direction_text(const Eigen::Vector3d& d) {
  std::string text;
  double sense = 0;
  for (Eigen::Index k = 0; k < 3; ++k) {
    const double x = std::round(d(k) * 1000) / 1000;
    if (x == 0) continue;
    if (sense == 0) sense = std::copysign(1, x);
    if (!text.empty()) text += x * sense > 0 ? " + " : " - ";
    text += (std::abs(x) == 1 ? "" : plain_number(std::abs(x)) + " ") + "XYZ"[k];
  }
  return text;
}

// Notice if no axis can move the tool in some direction of the workpiece, because two linear axes
// are parallel at these positions of the rotary axes. The limit is the same as for the residual
// error of one command. A machine with fewer than three linear axes gets no notice for the
// directions in which it can never move.
Notices fixed_direction_notices(const VolumetricTable& table) {
  double largest = 0;
  for (std::size_t k = 0; k < 3; ++k)
    largest = std::max(largest, std::abs(algo::largest_correction_m(table, k)));
  const double limit = algo::ResidualLimits{}.of(largest + table.place_left_m, kStepOfTables_m);
  if (!(table.place_left_m > limit)) return {};
  const Machine machine = nominal_machine(table.machine);
  algo::Command at{};
  std::copy(table.rotary_rad.begin(), table.rotary_rad.end(), at.begin() + 3);
  const Eigen::MatrixXd fixed = algo::fixed_directions(machine, at);
  std::vector<std::string> axes, directions;
  for (const MachineFrame& frame : machine.frames)
    if (frame.kind == FrameKind::linear) axes.push_back(frame.id);
  if (static_cast<std::size_t>(fixed.cols()) + axes.size() <= 3) return {};
  for (const Eigen::Vector3d direction : fixed.colwise())
    directions.push_back(direction_text(direction));
  return {notice(NoticeCode::volume_direction_left, "",
                 {{"axes", names_of(axes)},
                  {"direction", names_of(directions)},
                  {"left_um", to_um(table.place_left_m)},
                  {"limit_um", to_um(limit)}})};
}

// Notices about the errors of the table, without the notices of its runs.
Notices own_notices(const VolumetricTable& table) {
  Notices own;
  if (!table.not_measured.empty())
    own.push_back(
        notice(NoticeCode::volume_incomplete, "", {{"errors", names_of(table.not_measured)}}));
  if (!table.beyond_tables.empty())
    own.push_back(
        notice(NoticeCode::volume_beyond_tables, "", {{"errors", names_of(table.beyond_tables)}}));
  for (std::size_t k = 0; k < 3; ++k) append(own, residual_notices(table, k));
  append(own, fixed_direction_notices(table));
  return own;
}

Result<std::vector<Run>> runs_of(store::Store& store, const VolumetricTable& table) {
  std::vector<Run> runs(table.runs.size());
  for (std::size_t i = 0; i < runs.size(); ++i) {
    MDOF_TRY(runs[i], store.run(table.runs[i]));
  }
  return runs;
}

// Notices for axes whose targets were all measured with one approach, but the approach of the table
// is the other one. The table then uses the errors of the measured approach, and the reversal error
// is unknown.
Notices one_sided(const VolumetricTable& table, const std::vector<Run>& runs) {
  // key: axis, and whether the run is imported (positioning).
  std::map<std::pair<Axis, bool>, std::set<std::string>> seen;
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
  MDOF_TRY(StoredErrors stored, read_stored_errors(store, machine));
  BuiltVolumetric built;
  MDOF_TRY(built.table, algo::build_volumetric(machine, request.grid));
  built.table.doubtful = stored.doubtful;
  built.table.description = request.description;
  built.table.runs = std::move(stored.runs);
  MDOF_TRY(const std::vector<Run> runs, runs_of(store, built.table));
  built.notices = own_notices(built.table);
  append(built.notices, one_sided(built.table, runs));
  MDOF_TRY(Notices of_runs, source_run_notices(store, built.table.runs));
  append(built.notices, std::move(of_runs));
  built.doubtful = without_information(built.notices);
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
  Notices found = without_information(own_notices(table));
  MDOF_TRY(const std::vector<Run> runs, runs_of(store, table));
  append(found, one_sided(table, runs));
  append(found, doubtful_notices(runs));
  MDOF_TRY(Notices of_runs, source_run_notices(store, table.runs));
  append(found, std::move(of_runs));
  for (const Notice& each : table.doubtful)
    if (std::find(found.begin(), found.end(), each) == found.end()) found.push_back(each);
  return found;
}

Result<Judged> judged_table(store::Store& store, const VolumetricTable& table) {
  Judged judged{JudgedKind::table, std::to_string(table.id), table.simulated, {}};
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
    return fail(ErrorCode::conflict,
                std::string("table ") + std::to_string(active->table.id) + " of axis " +
                    letter(axis) +
                    " is active; if a volumetric table were active too, the controller would "
                    "correct the errors twice",
                Remedy::deactivate_axis, std::string(1, letter(axis)));
  }
  MDOF_TRY(const Judged judged, judged_table(store, table));
  const auto now = store.active_volumetric();
  if (!(now && now->table.id == id))
    MDOF_CHECK(check_gate(judged, consent, "the table is not activated"));
  return store::Marks{judged.simulated, !judged.doubtful.empty()};
}

Status check_no_volumetric(store::Store& store) {
  const auto active = store.active_volumetric();
  if (!active && active.error().code == ErrorCode::not_found) return {};
  if (!active) return tl::unexpected(active.error());
  return fail(ErrorCode::conflict,
              "the volumetric table " + std::to_string(active->table.id) +
                  " is active; if the table of an axis were active too, the controller would "
                  "correct the errors twice",
              Remedy::deactivate_volume);
}

}  // namespace mdof::daemon
