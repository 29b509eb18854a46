// Results of stored runs: what the command line and the daemon make of them, in one way.
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

// A stored run as `mdof show` and run.get give it: its members, those made on reading (the lines of
// straightness), the hash of its result, and who did what with it.
std::string run_document(const RunMembers& members, const std::string& result_sha256,
                         const std::vector<HistoryEntry>& actions);

// The rig of a run, with the machine of its configuration where the rig has none.
Result<Rig> rig_of(const RunHeader& run);

// The run, stated anew. Error: the tool is asked for and the rig has no tool_point_mm.
Result<Run> run_stated_at(store::Store& store, std::int64_t run, Reference reference);

// Its first point, with which its drift begins, and behind it `count` from `offset` on; without
// figures.
Result<Run> points_stated_at(store::Store& store, std::int64_t run, std::int64_t offset,
                             std::int64_t count, Reference reference);

struct TableRequest {
  std::vector<std::int64_t> runs;
  bool keep_slope = false;
  bool partial = false;                // take partial runs as well
  std::optional<Reference> reference;  // none: at the rig's tool point, else at the fixture
  std::optional<HistoryEntry> action = std::nullopt;  // who asks
  algo::TableLimits limits = {};
  // Of imported positioning whose runs do not say it: travel "-" of the machine.
  std::optional<bool> against_command = std::nullopt;
};
struct BuiltTable {
  CompensationTable table;
  Notices notices;   // of the runs it is made from
  Notices doubtful;  // what of these keeps it from a controller
};
// Built and stored. Errors: those of algo::build_table() and algo::check_limits(); runs of rigs
// with other machines.
Result<BuiltTable> build_table(store::Store& store, const TableRequest& request);
// The two parts of that: what takes long, from a store that may be read-only, and storing.
Result<BuiltTable> calculate_table(store::Store& store, const TableRequest& request);
Status store_table(store::Store& store, CompensationTable& table,
                   const std::optional<HistoryEntry>& action);

// Means of a run by target, as a table of this run alone has them: straightness as measured and
// where the run states it, angles relative to the first target, u with what its rig declares.
// Errors: those of algo::build_table() and algo::add_declared_uncertainty().
Result<CompensationTable> means_by_target(const Run& run);

struct ActivationRequest {
  std::int64_t table = 0;
  Consent consent;
  HistoryEntry action;                                             // who asks
  std::optional<std::int64_t> expected_generation = std::nullopt;  // of all active tables
};
// Activates the table. Refuses one that is not what its hash says, and what check_gate()
// refuses: a controller sees numbers only.
Result<store::Activation> activate_table(store::Store& store, const ActivationRequest& request);
// The two parts of that: what may refuse it, from a store that may be read-only, with the marks of
// the table; and storing.
Result<store::Marks> check_activation(store::Store& store, const ActivationRequest& request);
Result<store::Activation> activate_checked(store::Store& store, const ActivationRequest& request,
                                           const store::Marks& marks);

inline constexpr std::array<AxisPair, 3> kAxisPairs = {
    {{Axis::x, Axis::y}, {Axis::x, Axis::z}, {Axis::y, Axis::z}}};
struct SquarenessRequest {
  std::int64_t run_a = 0, run_b = 0;  // in the order X, Y, Z of their axes
  algo::ArtefactGiven given;
  bool partial = false;
  std::optional<HistoryEntry> action = std::nullopt;  // who asks
  std::optional<AxisPair> axes = std::nullopt;        // that the runs have to be of
};
// Two runs with their rigs, and the fit without the uncertainty of what the rigs declare.
struct RunsOfSquareness {
  Run a, b;
  Rig rig_a, rig_b;
  Squareness fitted;
};
// Errors: no such run; a run of another axis than the request says; those of algo::artefact_of()
// and algo::squareness().
Result<RunsOfSquareness> runs_of_squareness(store::Store& store, const SquarenessRequest& request);
struct FittedSquareness {
  Squareness squareness;
  std::vector<Budget> budgets;  // of EC0Y, then of EYX_slope_urad and EXY_slope_urad; with Z alike
  Notices notices;
};
// Fitted, and stored unless the same fit is stored already. Errors: those of algo::artefact_of(),
// algo::squareness() and algo::squareness_budget().
Result<FittedSquareness> fit_squareness(store::Store& store, const SquarenessRequest& request);
// The two parts of that: what takes long, from a store that may be read-only, and storing.
Result<FittedSquareness> calculate_squareness(store::Store& store,
                                              const SquarenessRequest& request);
Status store_squareness(store::Store& store, Squareness& squareness,
                        const std::optional<HistoryEntry>& action);
// The same of one that is stored, its uncertainties made anew; by the same lines at other points
// where `at` names some, as tables of the axes may be stated.
Result<FittedSquareness> stored_squareness(store::Store& store, Squareness squareness,
                                           const algo::StatedPair& at = {});

// Both axes by each reference line, made on reading: what is stored is the fit by least squares.
Result<SquarenessLines> lines_of_squareness(store::Store& store, const Squareness& squareness);
// A fit as `mdof squareness` and squareness.fit give it.
std::string squareness_document(const FittedSquareness& fitted, const SquarenessLines& lines);

}  // namespace mdof::daemon
