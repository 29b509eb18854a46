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

// Smaller steps are irrelevant, because a corrected command is rounded to this step.
constexpr double kStepOfTables_m = 1e-9;

std::string names_of(const std::vector<std::string>& names) {
  std::string text;
  for (const std::string& name : names) text += (text.empty() ? "" : ", ") + name;
  return text;
}

// Notices on the residual error of one command, from the two approaches and from interpolation
// between nodes. A notice is doubtful if the self-test of an export would reject the sum of both
// errors: then the larger one, and the other one if it alone is too large.
Notices residual_notices(const VolumetricTable& table, std::size_t k) {
  const std::string command(1, "XYZ"[k]);
  const double reversal = table.reversal_m[k], between = table.interpolation_m[k];
  const double largest = algo::largest_correction_m(table, k);
  const double limit = algo::ResidualLimits{}.of(largest + reversal, kStepOfTables_m);
  const auto too_large = [&](double part, double other) {
    return part > limit || (part + other > limit && part >= other);
  };
  Notices left;
  if (too_large(reversal, between))
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

// Text of a direction: "Z", "0.866 X + 0.5 Z". Its sense is irrelevant, so the first number is
// positive.
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

// A direction of the work in which no axis moves the tool, because two linear axes are parallel at
// the positions of the rotary axes. The notice is doubtful by the same limit as for one command. It
// is expected if the machine has no third axis; the residual error is then stated as for every
// table.
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

// Notices of the table on its own errors.
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

// Axes whose targets were all approached from one side, which is not the approach of the table. The
// table then uses the errors of this side for its own approach, so it contains no reversal error.
Notices one_sided(const VolumetricTable& table, const std::vector<Run>& runs) {
  std::map<std::pair<Axis, bool>, std::set<std::string>> seen;  // positioning is a separate
                                                                // measurement
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
  MDOF_TRY(Notices superseded, superseded_notices(store, table.runs));
  append(found, std::move(superseded));
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
