#include "algo/compensation/shared_quantities.h"

#include <cmath>
#include <map>
#include <set>
#include <utility>

#include "algo/model/restate.h"
#include "algo/uncertainty/contributors.h"

namespace mdof::algo {
namespace {

// Limit of the number of points of each table, the same as in declared_uncertainty.cpp.
constexpr std::size_t kMostSharedPoints = 20'000;

// A contributor in one run of one table.
struct InRun {
  std::size_t table = 0, run = 0;
  Contributor contributor;
};

bool is_shared_by_tables(const std::vector<InRun>& all) {
  std::set<std::size_t> tables;
  for (const InRun& one : all) tables.insert(one.table);
  return tables.size() > 1;
}

// Returns the contributors with the same Contributor::common_as together. `runs` has the runs of
// each table, converted to the reference point of the table.
Result<std::map<std::string, std::vector<InRun>>> quantities_of(
    const std::vector<BuiltFrom>& tables, const std::vector<std::vector<Run>>& runs) {
  std::map<std::string, std::vector<InRun>> all;
  for (std::size_t t = 0; t < tables.size(); ++t) {
    std::size_t points = 0;
    for (std::size_t r = 0; r < runs[t].size(); ++r) {
      if (!tables[t].rigs[r].declares_uncertainty()) continue;
      points += runs[t][r].points.size();
      if (points > kMostSharedPoints)
        return bad_input(
            "the runs of a table have more than " + std::to_string(kMostSharedPoints) +
            " points, the limit for runs with declared uncertainties; leave some runs out");
      MDOF_TRY(const auto of_run, contributors(tables[t].rigs[r], runs[t][r]));
      for (const Contributor& contributor : of_run)
        if (!contributor.common_as.empty())
          all[contributor.common_as].push_back({t, r, contributor});
    }
  }
  std::erase_if(all, [](const auto& of) { return !is_shared_by_tables(of.second); });
  return all;
}

Result<std::vector<Errors5>> table_changes(const BuiltFrom& of, const std::vector<Run>& shifted) {
  MDOF_TRY(const MeanTable built, mean_table(shifted, of.options));
  std::vector<Errors5> changes(of.table.position_m.size());
  for (std::size_t row = 0; row < changes.size(); ++row)
    for (std::size_t k = 0; k < kErrorCount; ++k) {
      const double by = built.table.forward[k][row] - of.table.forward[k][row];
      if (std::isfinite(by)) changes[row][k] = by;
    }
  return changes;
}

}  // namespace

Result<std::vector<SharedQuantity>> shared_quantities(const std::vector<BuiltFrom>& tables) {
  std::vector<std::vector<Run>> runs;
  for (const BuiltFrom& of : tables) {
    runs.emplace_back();
    for (const Run& run : of.runs) runs.back().push_back(restate(run, of.options.stated));
  }
  MDOF_TRY(const auto quantities, quantities_of(tables, runs));
  std::vector<SharedQuantity> all;
  for (const auto& [common_as, in_runs] : quantities) {
    std::vector<std::vector<PointShifts>> parts;  // [element of in_runs][part]
    for (const InRun& one : in_runs) parts.push_back(one.contributor.parts());
    for (std::size_t p = 0; p < parts.front().size(); ++p) {
      SharedQuantity& shared =
          all.emplace_back(SharedQuantity{in_runs.front().contributor.name, {}});
      for (std::size_t t = 0; t < tables.size(); ++t) {
        std::vector<Run> shifted = runs[t];
        for (std::size_t i = 0; i < in_runs.size(); ++i)
          if (in_runs[i].table == t && p < parts[i].size())
            shift(shifted[in_runs[i].run].points, parts[i][p]);
        MDOF_TRY(auto changes, table_changes(tables[t], shifted));
        shared.by_table.push_back(std::move(changes));
      }
    }
  }
  return all;
}

}  // namespace mdof::algo
