#include "daemon/measure/machine/stored_errors.h"

#include <algorithm>
#include <cmath>
#include <optional>

#include "algo/compensation/error_covariance.h"
#include "algo/compensation/imported_table.h"
#include "algo/compensation/shared_quantities.h"
#include "daemon/measure/evaluation.h"
#include "daemon/measure/gate/gate.h"
#include "daemon/measure/machine/table_functions.h"
#include "schema/imported/series.h"
#include "schema/units.h"

namespace mdof::daemon {
namespace {

constexpr std::int64_t kPage = 50;

std::string axis_of(const MachineFrame& frame) {
  return "axis " + frame.id + " of the machine: ";
}

Status take(MachineFrame& frame, std::size_t k, ErrorFunction function) {
  if (function.forward.empty()) return {};
  const std::string name = error_name(frame, k);
  if (frame.error[k].known() || !frame.error[k].file.empty())
    return bad_input(axis_of(frame) + name + " is given twice; give the error once");
  MDOF_CHECK(check_function(function, k, axis_of(frame) + name));
  frame.error[k] = std::move(function);
  return {};
}

// If the description of the machine differs from the rigs of the table, signs would be wrong.
Status check_set_up(const Machine& machine, const MachineFrame& frame,
                    const CompensationTable& table) {
  const std::string of = axis_of(frame);
  if (table.lacks_reference_point || table.stated.reference == Reference::carriage)
    return bad_input(of +
                     "the reference point of the table is the carriage, or is unknown; build a "
                     "table whose reference point is the fixture");
  if (table.sides.fixture_moves != frame.point_moves)
    return bad_input(of + "point must be \"" + (frame.point_moves ? "standing" : "moving") +
                     "\" in the machine file, because the rig states that the " +
                     table.sides.moves() + " moves");
  if (table.sides.against_encoder != frame.against_command)
    return bad_input(of + "the rig states travel \"" + table.sides.travel() +
                     "\", but the machine file states the opposite; correct the wrong file");
  if (table.machine.known() && table.machine != machine.chain)
    return bad_input(of + "the rig states the chain " + table.machine.text + " (" +
                     chain_travels_text(table.machine) + "), but the machine file states " +
                     machine.chain.text + " (" + chain_travels_text(machine.chain) +
                     "); correct the wrong file");
  return {};
}

// Reference point of the straightness of a measured axis, and whether the slope of the straightness
// is removed.
struct StatedStraightness {
  std::string axis;
  StatedAt at = kAtFixture;
  bool slope_removed = true;
};
using StatedAxes = std::vector<StatedStraightness>;

// The reference point of an axis in its squareness to other axes. It is the reference point of the
// table of the axis.
Result<StatedAt> point_of_slope(const MachineFrame& frame, const StatedAxes& stated) {
  StatedAt at = kAtFixture;
  for (const StatedStraightness& s : stated) {
    if (s.axis != frame.id) continue;
    if (!s.slope_removed)
      return bad_input(axis_of(frame) +
                       "the table of this axis contains the straightness slope, and the squareness "
                       "contains the same slope, so the slope would count twice; build the table "
                       "without the slope, or remove the squareness from the machine file");
    at = s.at;
  }
  return at;
}

// The tables of measured runs that a machine uses.
struct UsedTables {
  std::vector<MachineFrame*> frames;
  std::vector<algo::BuiltFrom> built_from;
  StatedAxes stated;
  Notices doubtful;
};

// Calculates the covariance of the errors of the table from the runs of the table. zero_m: position
// of the axis during the measurement of the other axes. The angles are 0 at this position.
Status set_table_covariance(store::Store& store, MachineFrame& frame,
                            const CompensationTable& table, double zero_m, UsedTables& taken) {
  algo::BuiltFrom of{{}, {}, {}, {table.slope_removed, true, table.stated, table.machine, zero_m}};
  for (const std::int64_t id : table.runs) {
    MDOF_TRY(Run run, store.run(id));
    MDOF_TRY(Rig rig, rig_of(run.header));
    of.runs.push_back(std::move(run));
    of.rigs.push_back(std::move(rig));
  }
  MDOF_TRY(of.table, algo::build_table(of.runs, of.options));
  const auto all = algo::error_covariances(of.table, of.rigs, of.runs, of.options);
  if (!all || of.table.position_m != table.position_m) {
    // The notices of the table state why the covariance is unknown.
    for (std::size_t k = 3; k < kBodyErrors; ++k) bound_angle_u(frame.error[k], zero_m);
    return {};
  }
  set_covariance(frame, of.table, *all);
  taken.frames.push_back(&frame);
  taken.built_from.push_back(std::move(of));
  return {};
}

// Adds the quantities that the probes of several axes share.
void add_shared_quantities(const UsedTables& taken) {
  const auto parts = algo::shared_quantities(taken.built_from);
  if (!parts) return;  // the notices of the table state why the shared quantities are unknown
  for (const algo::SharedQuantity& part : *parts)
    for (std::size_t t = 0; t < taken.frames.size(); ++t)
      add_shared(*taken.frames[t], taken.built_from[t].table, contributor_text(part.name),
                 part.by_table[t]);
}

Status take_table(store::Store& store, Machine& machine, MachineFrame& frame,
                  const CompensationTable& table, UsedTables& taken) {
  machine.simulated = machine.simulated || table.simulated;
  if (table.has_positioning()) {
    for (const std::int64_t id : table.runs) {
      MDOF_TRY(const RunHeader header, store.run_header(id));
      MDOF_CHECK(algo::check_travel(header, frame.against_command));
    }
    const PositioningErrors& along = table.positioning;
    const std::vector<double> noise = larger(along.u_forward, along.u_reverse);
    std::vector<double> u;
    for (std::size_t i = 0; i < noise.size(); ++i)
      u.push_back(std::fmax(table.positioning_u_at(true, i), table.positioning_u_at(false, i)));
    // The table is in controller coordinates. Errors of the body are positive in the + direction.
    const double body = frame.against_command ? -1 : 1;
    ErrorFunction function = error_function(table.position_m, scaled(along.forward, body),
                                            scaled(along.reverse, body), u, noise);
    function.noise_only = table.noise_only();
    return take(frame, frame.direction, std::move(function));
  }
  MDOF_CHECK(check_set_up(machine, frame, table));
  taken.stated.push_back({frame.id, table.stated, table.slope_removed});
  const double zero_m = frame.angles_zero_m.value_or(0);
  MDOF_CHECK(check_angles_zero(frame, table.position_m, taken.doubtful));
  for (std::size_t named = 0; named < 5; ++named) {
    std::vector<double> u;
    for (std::size_t row = 0; row < table.position_m.size(); ++row)
      u.push_back(std::fmax(table.u_of(table.u_forward, named, row),
                            table.u_of(table.u_reverse, named, row)));
    ErrorFunction function =
        error_function(table.position_m, table.forward[named], table.reverse[named], u,
                       larger(table.u_forward[named], table.u_reverse[named]));
    function.noise_only = table.noise_only();
    if (error_names(table.axis)[named].angle) set_angle_zero_at(function, zero_m);
    MDOF_CHECK(take(frame, body_error_index(table, named), std::move(function)));
  }
  return set_table_covariance(store, frame, table, zero_m, taken);
}

void add_new(const std::vector<std::int64_t>& from, std::vector<std::int64_t>& to) {
  for (const std::int64_t id : from)
    if (std::find(to.begin(), to.end(), id) == to.end()) to.push_back(id);
}

// The newest complete measured run, and the newest complete imported run of positioning.
Result<std::vector<std::int64_t>> latest_runs(store::Store& store, const MachineFrame& frame) {
  const auto axis = axis_from(frame.id);
  std::optional<std::int64_t> measured, positioning;
  for (std::int64_t offset = 0; axis && !(measured && positioning); offset += kPage) {
    MDOF_TRY(const auto runs, store.list_runs(offset, kPage, axis, store::Store::Listed::results));
    if (runs.empty()) break;
    for (const RunHeader& run : runs) {
      if (run.state != RunState::complete) continue;
      const bool imported = is_imported(run);
      if (!imported && !measured) measured = run.id;
      if (imported && !positioning && run.provenance.model == positioning_name(*axis))
        positioning = run.id;
    }
  }
  std::vector<std::int64_t> ids;
  for (const auto& id : {measured, positioning})
    if (id) ids.push_back(*id);
  if (!ids.empty()) return ids;
  return fail(
      ErrorCode::not_found,
      store.file().string() + ": no complete run of axis " + frame.id +
          " is stored, but the machine file has runs = \"latest\"; measure this axis first");
}

Status take_runs(store::Store& store, Machine& machine, MachineFrame& frame, StoredErrors& all,
                 UsedTables& taken) {
  std::vector<std::int64_t> ids = frame.runs.ids;
  if (frame.runs.latest) {
    MDOF_TRY(ids, latest_runs(store, frame));
  }
  // Imported positioning and measured runs need separate tables.
  TableRequest measured, imported;
  measured.reference = Reference::fixture;
  imported.against_command = frame.against_command;
  for (const std::int64_t id : ids) {
    MDOF_TRY(const RunHeader header, store.run_header(id));
    if (letter(header.axis) != frame.id[0] || frame.kind != FrameKind::linear)
      return bad_input(axis_of(frame) + "run " + std::to_string(id) + " measures axis " +
                       letter(header.axis) + "; give runs of axis " + frame.id);
    (is_imported(header) ? imported : measured).runs.push_back(id);
  }
  for (const TableRequest* request : {&measured, &imported}) {
    if (request->runs.empty()) continue;
    MDOF_TRY(const BuiltTable built, calculate_table(store, *request));
    append(all.notices, built.notices);
    append(all.doubtful, built.doubtful);
    MDOF_CHECK(take_table(store, machine, frame, built.table, taken));
  }
  add_new(ids, all.runs);
  return {};
}

Status take_tables(store::Store& store, Machine& machine, MachineFrame& frame, StoredErrors& all,
                   UsedTables& taken) {
  for (const std::int64_t id : frame.tables.ids) {
    MDOF_TRY(const CompensationTable table, store.table(id));
    if (letter(table.axis) != frame.id[0] || frame.kind != FrameKind::linear)
      return bad_input(axis_of(frame) + "table " + std::to_string(id) + " is for axis " +
                       letter(table.axis) + "; give tables for axis " + frame.id);
    MDOF_TRY(Notices doubtful, doubtful_notices(store, table));
    append(all.doubtful, std::move(doubtful));
    MDOF_CHECK(take_table(store, machine, frame, table, taken));
    add_new(table.runs, all.runs);
  }
  return {};
}

bool has(const std::vector<std::int64_t>& ids, std::int64_t id) {
  return std::find(ids.begin(), ids.end(), id) != ids.end();
}

// The newest squareness that the predicate accepts, or nullopt.
template <class Predicate>
Result<std::optional<Squareness>> newest_squareness(store::Store& store, Predicate accepts) {
  for (std::int64_t offset = 0;; offset += kPage) {
    MDOF_TRY(const auto list, store.list_squareness(offset, kPage));
    if (list.empty()) return std::nullopt;
    const auto found = std::find_if(list.begin(), list.end(), accepts);
    if (found != list.end()) return *found;
  }
}

std::string no_axes(AxisPair axes) {
  return std::string("; calculate the squareness from a run of axis ") + letter(axes.a) +
         " and a run of axis " + letter(axes.b);
}

// The newest squareness of each pair of axes. If axes of the description name runs, only a
// squareness from these runs is used.
Result<std::vector<Squareness>> latest_squareness(store::Store& store, const Machine& machine,
                                                  const std::vector<std::int64_t>& runs) {
  std::vector<Squareness> all;
  for (const AxisPair axes : kAxisPairs) {
    if (!machine.find(std::string(1, letter(axes.a))) ||
        !machine.find(std::string(1, letter(axes.b))))
      continue;
    MDOF_TRY(const auto found, newest_squareness(store, [&](const Squareness& s) {
               return s.axes == axes &&
                      (runs.empty() || (has(runs, s.run_a) && has(runs, s.run_b)));
             }));
    if (found) all.push_back(*found);
  }
  if (!all.empty()) return all;
  return fail(ErrorCode::not_found,
              store.file().string() + ": no squareness is stored" +
                  (runs.empty() ? no_axes({})
                                : " for the runs that the machine file names; calculate the "
                                  "squareness from two of these runs that measure different axes"));
}

Result<std::vector<Squareness>> squareness_of(store::Store& store, const Machine& machine,
                                              const std::vector<std::int64_t>& runs) {
  if (machine.squareness.latest) return latest_squareness(store, machine, runs);
  std::vector<Squareness> all;
  for (const std::int64_t id : machine.squareness.ids) {
    MDOF_TRY(const Squareness found, find_squareness(store, id));
    all.push_back(found);
  }
  return all;
}

Result<MachineFrame*> frame_of(Machine& machine, AxisPair axes, Axis axis) {
  for (MachineFrame& frame : machine.frames)
    if (frame.id == std::string(1, letter(axis))) return &frame;
  return bad_input(std::string("squareness of the machine: the stored squareness is for axes ") +
                   letter(axes.a) + " and " + letter(axes.b) + ", but the chain " +
                   machine.chain.text + " has no axis " + letter(axis) +
                   "; give another squareness");
}

Status use_stored_squareness(store::Store& store, Machine& machine, const Squareness& stored,
                             const StatedAxes& stated, StoredErrors& all) {
  MDOF_TRY(MachineFrame* const a, frame_of(machine, stored.axes, stored.axes.a));
  MDOF_TRY(MachineFrame* const b, frame_of(machine, stored.axes, stored.axes.b));
  // Index of A, B or C about the third axis.
  const std::size_t about = 6 - a->direction - b->direction;
  if (a->location[about].value || b->location[about].value)
    return bad_input("squareness of the machine: " +
                     with_unit(location_name(b->location[about].value ? *b : *a, about), about) +
                     " is given more than once (by \"squareness\" and by a key of an axis, or "
                     "twice in \"squareness\"); give this angle only once");
  algo::StatedPair at;
  MDOF_TRY(at.a, point_of_slope(*a, stated));
  MDOF_TRY(at.b, point_of_slope(*b, stated));
  MDOF_TRY(const FittedSquareness fitted, stored_squareness(store, stored, at));
  b->location[about].value = fitted.squareness.error_rad;
  b->location[about].u = std::nullopt;
  if (const double u_rad = fitted.squareness.u_error_rad; !std::isnan(u_rad))
    b->location[about].u = u_rad;
  b->location[about].noise_only = !fitted.budgets.empty() && fitted.budgets.front().noise_only;
  machine.simulated = machine.simulated || fitted.squareness.simulated;
  append(all.notices, fitted.notices);
  append(all.doubtful, without_information(fitted.notices));
  return {};
}

Status use_stored_squareness(store::Store& store, Machine& machine, const StatedAxes& stated,
                             StoredErrors& all) {
  const std::vector<std::int64_t> named = all.runs;
  MDOF_TRY(const auto fits, squareness_of(store, machine, named));
  for (const Squareness& s : fits) {
    MDOF_CHECK(use_stored_squareness(store, machine, s, stated, all));
    if (!named.empty() && !(has(named, s.run_a) && has(named, s.run_b))) {
      Notice other = notice(NoticeCode::squareness_of_unnamed_runs, "",
                            {{"squareness", s.id},
                             {"error", squareness_name(s.axes)},
                             {"axis_a", std::string(1, letter(s.axes.a))},
                             {"run_a", s.run_a},
                             {"axis_b", std::string(1, letter(s.axes.b))},
                             {"run_b", s.run_b}});
      append(all.notices, {other});
      append(all.doubtful, {other});
    }
    add_new({s.run_a, s.run_b}, all.runs);
  }
  return {};
}

// Error: a table contains its straightness slope, and a key of an axis states the squareness that
// contains the same slope. The slope would count twice.
Status check_slopes(const Machine& machine, const StatedAxes& stated) {
  for (const StatedStraightness& s : stated) {
    if (s.slope_removed) continue;
    for (const MachineFrame& frame : machine.frames)
      for (std::size_t about = 3; about < kBodyErrors; ++about)
        if (frame.location[about].value && "XYZ"[about - 3] != s.axis.front())
          return bad_input(
              "axis " + s.axis +
              " of the machine: the table of this axis contains the straightness slope, and " +
              location_name(frame, about) +
              " contains the same slope, so the slope would count twice; build the table without "
              "the slope, or remove the angle from the machine file");
  }
  return {};
}

}  // namespace

Result<Squareness> find_squareness(store::Store& store, std::optional<std::int64_t> id,
                                   AxisPair latest_of) {
  MDOF_TRY(const auto found, newest_squareness(store, [&](const Squareness& s) {
             return id ? s.id == *id : s.axes == latest_of;
           }));
  if (found) return *found;
  return fail(ErrorCode::not_found,
              store.file().string() + (id ? ": there is no squareness " + std::to_string(*id)
                                          : ": no squareness is stored" + no_axes(latest_of)));
}

Result<StoredErrors> read_stored_errors(store::Store& store, Machine& machine) {
  StoredErrors all;
  UsedTables taken;
  for (MachineFrame& frame : machine.frames) {
    MDOF_CHECK(take_runs(store, machine, frame, all, taken));
    MDOF_CHECK(take_tables(store, machine, frame, all, taken));
  }
  append(all.notices, taken.doubtful);
  append(all.doubtful, taken.doubtful);
  add_shared_quantities(taken);
  MDOF_CHECK(check_slopes(machine, taken.stated));
  if (machine.squareness.any())
    MDOF_CHECK(use_stored_squareness(store, machine, taken.stated, all));
  for (MachineFrame& frame : machine.frames) frame.runs = frame.tables = {};
  machine.squareness = {};
  return all;
}

}  // namespace mdof::daemon
