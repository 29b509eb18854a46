// Evaluates stored runs. The command line and the daemon use the same functions.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "algo/compensation/table_limits.h"
#include "algo/iso230/squareness.h"
#include "daemon/measure/gate/gate.h"
#include "daemon/store/store.h"
#include "schema/base/result.h"
#include "schema/compensation_table.h"
#include "schema/iso230/reference_lines.h"
#include "schema/notice/notice.h"
#include "schema/rig/rig.h"
#include "schema/run.h"
#include "schema/run_json.h"
#include "schema/uncertainty/budget.h"

namespace mdof::daemon {

// The document of `mdof show` and run.get. It contains the stored members, the members that are
// calculated on request (straightness for each reference line), the hash of the result, and the
// history.
std::string run_document(const RunMembers& members, const std::string& result_sha256,
                         const std::vector<HistoryEntry>& actions);

// Reads the rig from the provenance of a run. If the rig does not state the machine, the machine is
// read from the configuration of the run.
Result<Rig> rig_of(const RunHeader& run);

// Reads a run and converts its errors to the given reference point. Error: the reference point is
// the tool, but the rig has no tool_point_mm.
Result<Run> restated_run(store::Store& store, std::int64_t run, Reference reference);

// Reads the first point of the run, and then `count` points from `offset`. The first point is
// always included, because the drift of the run is counted from it. The result has no figures.
Result<Run> restated_points(store::Store& store, std::int64_t run, std::int64_t offset,
                            std::int64_t count, Reference reference);

struct TableRequest {
  std::vector<std::int64_t> runs;
  bool keep_slope = false;
  bool partial = false;  // also use partial runs
  // Reference point of the errors of the table. Default: the tool if the rig states tool_point_mm,
  // otherwise the fixture.
  std::optional<Reference> reference;
  std::optional<HistoryEntry> action = std::nullopt;  // the requesting user
  algo::TableLimits limits = {};
  // Travel of the machine: true means "-". It is used only for imported runs of positioning that do
  // not state their travel.
  std::optional<bool> against_command = std::nullopt;
  // The table that the controller applied during the runs. Its values are added to the errors of
  // the runs. Then the slope and the reference point are those of this table.
  std::optional<std::int64_t> add_to = std::nullopt;
};
struct BuiltTable {
  CompensationTable table;
  Notices notices;   // notices of the source runs
  Notices doubtful;  // the notices for which check_gate() rejects the table
};
// Calculates and stores a table. Errors: those of algo::build_table(), algo::add_applied() and
// algo::check_limits(); the rigs of the runs state different machines; during one of the runs, the
// table `add_to` was not active or another table was active, too.
Result<BuiltTable> build_table(store::Store& store, const TableRequest& request);
// The two steps of build_table(). calculate_table() can take long and needs only a read-only store.
// store_table() stores the result.
Result<BuiltTable> calculate_table(store::Store& store, const TableRequest& request);
Status store_table(store::Store& store, CompensationTable& table,
                   const std::optional<HistoryEntry>& action);

// Means of a run for each target, as in a table of this run alone. The straightness contains its
// slope. The reference point is the reference point of the run. The angles are relative to the
// first target. u includes the uncertainties that the rig declares. Errors: those of
// algo::build_table() and algo::add_declared_uncertainty().
Result<CompensationTable> means_by_target(const Run& run);

struct ActivationRequest {
  std::int64_t table = 0;
  Consent consent;
  HistoryEntry action;  // the requesting user
  // If set, the activation fails unless the generation of all active tables is this number.
  std::optional<std::int64_t> expected_generation = std::nullopt;
};
// Activates the table. Rejects a table whose content does not match its hash. Also rejects every
// table that check_gate() rejects: a controller reads only the numbers, without the notices.
Result<store::Activation> activate_table(store::Store& store, const ActivationRequest& request);
// The two steps of activate_table(). check_activation() makes the checks, needs only a read-only
// store and returns whether the table is simulated or doubtful. activate_checked() stores the
// activation.
Result<store::Marks> check_activation(store::Store& store, const ActivationRequest& request);
Result<store::Activation> activate_checked(store::Store& store, const ActivationRequest& request,
                                           const store::Marks& marks);

inline constexpr std::array<AxisPair, 3> kAxisPairs = {
    {{Axis::x, Axis::y}, {Axis::x, Axis::z}, {Axis::y, Axis::z}}};
struct SquarenessRequest {
  // The axis of run_a must be before the axis of run_b in the order X, Y, Z.
  std::int64_t run_a = 0, run_b = 0;
  algo::ArtefactGiven given;
  bool partial = false;
  std::optional<HistoryEntry> action = std::nullopt;  // the requesting user
  std::optional<AxisPair> axes = std::nullopt;        // required axes of the runs
};
// Two runs with their rigs, and their squareness. u of this squareness does not include the
// uncertainties that the rigs declare.
struct SquarenessRuns {
  Run a, b;
  Rig rig_a, rig_b;
  Squareness fitted;
};
// Errors: a run is unknown or has another axis than requested; those of algo::combined_artefact()
// and algo::squareness().
Result<SquarenessRuns> squareness_runs(store::Store& store, const SquarenessRequest& request);
struct FittedSquareness {
  Squareness squareness;
  std::vector<Budget> budgets;  // for X and Y: EC0Y, EYX_slope_urad, EXY_slope_urad; for other axes
                                // in the same order
  Notices notices;
};
// Fits the squareness and stores it, unless the same fit is stored already. Errors: those of
// algo::combined_artefact(), algo::squareness() and algo::squareness_budget().
Result<FittedSquareness> fit_squareness(store::Store& store, const SquarenessRequest& request);
// The two steps of fit_squareness(). calculate_squareness() can take long and needs only a
// read-only store. store_squareness() stores the result.
Result<FittedSquareness> calculate_squareness(store::Store& store,
                                              const SquarenessRequest& request);
Status store_squareness(store::Store& store, Squareness& squareness,
                        const std::optional<HistoryEntry>& action);
// Calculates the uncertainties of a stored squareness again. `at`: reference points of the two
// axes, for example those of their tables. If a point is not the fixture, the angle and the slopes
// are calculated again for these points.
Result<FittedSquareness> stored_squareness(store::Store& store, Squareness squareness,
                                           const algo::StatedPair& at = {});

// The squareness for each kind of reference line, calculated on request. The stored squareness uses
// least-squares lines.
Result<SquarenessByLine> squareness_by_reference_line(store::Store& store,
                                                      const Squareness& squareness);
// The document of `mdof squareness` and squareness.fit.
std::string squareness_document(const FittedSquareness& fitted, const SquarenessByLine& lines);

}  // namespace mdof::daemon
