// Evaluates stored runs, in the same way for the command line and the daemon.
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

// The document of `mdof show` and run.get: the stored members, the members that are calculated on
// request (straightness lines), the hash of the result and the history.
std::string run_document(const RunMembers& members, const std::string& result_sha256,
                         const std::vector<HistoryEntry>& actions);

// The rig of a run. If the rig has no machine, it gets that of the run's configuration.
Result<Rig> rig_of(const RunHeader& run);

// The run at another reference point. Error: the tool is requested and the rig has no
// tool_point_mm.
Result<Run> restated_run(store::Store& store, std::int64_t run, Reference reference);

// The first point of the run (needed as the start of its drift), followed by `count` points from
// `offset`; without figures.
Result<Run> restated_points(store::Store& store, std::int64_t run, std::int64_t offset,
                            std::int64_t count, Reference reference);

struct TableRequest {
  std::vector<std::int64_t> runs;
  bool keep_slope = false;
  bool partial = false;                // also use partial runs
  std::optional<Reference> reference;  // default: the rig's tool point, otherwise the fixture
  std::optional<HistoryEntry> action = std::nullopt;  // the requesting user
  algo::TableLimits limits = {};
  // For imported positioning whose runs do not state the travel: true means travel "-" of the
  // machine.
  std::optional<bool> against_command = std::nullopt;
};
struct BuiltTable {
  CompensationTable table;
  Notices notices;   // notices of the source runs
  Notices doubtful;  // those notices that prevent the use by a controller
};
// Calculates and stores the table. Errors: those of algo::build_table() and algo::check_limits();
// runs whose rigs have different machines.
Result<BuiltTable> build_table(store::Store& store, const TableRequest& request);
// The two parts of build_table(): the long calculation, for which a read-only store is enough, and
// the storing.
Result<BuiltTable> calculate_table(store::Store& store, const TableRequest& request);
Status store_table(store::Store& store, CompensationTable& table,
                   const std::optional<HistoryEntry>& action);

// Means of a run by target, as in a table of this run alone: straightness with its slope and at the
// stated point of the run, angles relative to the first target, u with the uncertainties that the
// rig declares. Errors: those of algo::build_table() and algo::add_declared_uncertainty().
Result<CompensationTable> means_by_target(const Run& run);

struct ActivationRequest {
  std::int64_t table = 0;
  Consent consent;
  HistoryEntry action;                                             // the requesting user
  std::optional<std::int64_t> expected_generation = std::nullopt;  // generation of all active
                                                                   // tables
};
// Activates the table. Rejects a table that does not match its hash, and everything that
// check_gate() rejects, because a controller sees only the numbers.
Result<store::Activation> activate_table(store::Store& store, const ActivationRequest& request);
// The two parts of activate_table(): the checks, for which a read-only store is enough and which
// return the marks of the table, and the storing.
Result<store::Marks> check_activation(store::Store& store, const ActivationRequest& request);
Result<store::Activation> activate_checked(store::Store& store, const ActivationRequest& request,
                                           const store::Marks& marks);

inline constexpr std::array<AxisPair, 3> kAxisPairs = {
    {{Axis::x, Axis::y}, {Axis::x, Axis::z}, {Axis::y, Axis::z}}};
struct SquarenessRequest {
  std::int64_t run_a = 0, run_b = 0;  // their axes must be in the order X, Y, Z
  algo::ArtefactGiven given;
  bool partial = false;
  std::optional<HistoryEntry> action = std::nullopt;  // the requesting user
  std::optional<AxisPair> axes = std::nullopt;        // required axes of the runs
};
// Two runs with their rigs, and the fit without the uncertainties that the rigs declare.
struct SquarenessRuns {
  Run a, b;
  Rig rig_a, rig_b;
  Squareness fitted;
};
// Errors: unknown run; run of an axis that was not requested; those of algo::combined_artefact()
// and algo::squareness().
Result<SquarenessRuns> squareness_runs(store::Store& store, const SquarenessRequest& request);
struct FittedSquareness {
  Squareness squareness;
  std::vector<Budget> budgets;  // EC0Y, then EYX_slope_urad and EXY_slope_urad; with Z alike
  Notices notices;
};
// Fits the squareness and stores it, unless the same fit is stored already. Errors: those of
// algo::combined_artefact(), algo::squareness() and algo::squareness_budget().
Result<FittedSquareness> fit_squareness(store::Store& store, const SquarenessRequest& request);
// The two parts of fit_squareness(): the long calculation, for which a read-only store is enough,
// and the storing.
Result<FittedSquareness> calculate_squareness(store::Store& store,
                                              const SquarenessRequest& request);
Status store_squareness(store::Store& store, Squareness& squareness,
                        const std::optional<HistoryEntry>& action);
// A stored squareness with newly calculated uncertainties. `at` may give other reference points, as
// tables of the axes may have; the lines stay the same.
Result<FittedSquareness> stored_squareness(store::Store& store, Squareness squareness,
                                           const algo::StatedPair& at = {});

// Both axes by each reference line, calculated on request. The stored fit is by least squares.
Result<SquarenessLines> squareness_reference_lines(store::Store& store,
                                                   const Squareness& squareness);
// The document of `mdof squareness` and squareness.fit.
std::string squareness_document(const FittedSquareness& fitted, const SquarenessLines& lines);

}  // namespace mdof::daemon
