#include "algo/compensation/declared_uncertainty.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <string>

#include "algo/model/restate.h"
#include "algo/uncertainty/contributors.h"
#include "schema/recording/run_options.h"

namespace mdof::algo {
namespace {

// Limits of the number of points, and of the number of points times the number of independent parts
// of all contributors. They keep the calculation time near one second. The solver runs several
// times for each point.
constexpr std::size_t kMostPoints = 20'000, kMostCost = 1'000'000;

// [part][run]: shifts due to a part of one contributor; empty for a run without this contributor.
using PartsOfRuns = std::vector<std::vector<PointShifts>>;

// Contributors with the same identity are one contributor. A contributor without a key belongs to
// one run only.
std::string identity(const Contributor& c, std::size_t run) {
  if (c.key.empty()) return std::to_string(run) + " " + contributor_text(c.name);
  return contributor_text(c.name) + " " + c.key + " " + std::to_string(c.declared.u * c.to_unit) +
         (c.surface ? " " + std::to_string(c.surface->length_m) : "");
}

// One contributor, and the runs to which it belongs.
struct Shared {
  std::vector<std::size_t> runs;
  std::vector<Contributor> of_run;
};

std::vector<std::vector<PointShifts>> parts_of_runs(const Shared& shared) {
  std::vector<std::vector<PointShifts>> parts;
  if (!shared.of_run.front().surface) {
    for (const Contributor& contributor : shared.of_run) parts.push_back(contributor.parts());
    return parts;
  }
  std::vector<const PlaneFootprints*> surfaces;
  for (const Contributor& contributor : shared.of_run)
    surfaces.push_back(contributor.surface.get());
  return flatness_parts(surfaces);
}

Result<std::map<std::string, PartsOfRuns>> all_contributors(const std::vector<Rig>& rigs,
                                                            const std::vector<Run>& runs) {
  std::map<std::string, Shared> declared;
  std::size_t points = 0, parts_in_all = 0;
  for (const Run& run : runs) points += run.points.size();
  const auto too_many = [] {
    return bad_input(
        "the runs have too many points: with the uncertainties that their rigs declare, the "
        "calculation would take too long; leave some runs out");
  };
  for (std::size_t r = 0; r < runs.size(); ++r) {
    if (!rigs[r].declares_uncertainty() && !run_options(runs[r].header).remove_drift) continue;
    if (points > kMostPoints) return too_many();
    MDOF_TRY(const auto of_run, contributors(rigs[r], runs[r]));
    for (const Contributor& contributor : of_run) {
      Shared& shared = declared[identity(contributor, r)];
      shared.runs.push_back(r);
      shared.of_run.push_back(contributor);
    }
  }
  std::map<std::string, PartsOfRuns> all;
  for (const auto& [name, shared] : declared) {
    auto parts = parts_of_runs(shared);
    PartsOfRuns& of = all[name];
    for (std::size_t i = 0; i < parts.size(); ++i) {
      if (of.size() < parts[i].size()) {
        parts_in_all += parts[i].size() - of.size();
        of.resize(parts[i].size(), std::vector<PointShifts>(runs.size()));
      }
      if (parts_in_all * points > kMostCost) return too_many();
      for (std::size_t p = 0; p < parts[i].size(); ++p)
        of[p][shared.runs[i]] = std::move(parts[i][p]);
    }
  }
  return all;
}

void add_products(const std::array<std::vector<double>, 5>& shifted,
                  const std::array<std::vector<double>, 5>& values,
                  std::vector<Covariance5>& products) {
  for (std::size_t i = 0; i < products.size(); ++i) {
    Errors5 by{};
    for (std::size_t k = 0; k < kErrorCount; ++k) {
      by[k] = shifted[k][i] - values[k][i];
      if (!std::isfinite(by[k])) by[k] = 0;
    }
    for (std::size_t k = 0; k < kErrorCount; ++k)
      for (std::size_t l = 0; l < kErrorCount; ++l)
        products[i][k * kErrorCount + l] += by[k] * by[l];
  }
}

}  // namespace

Result<DeclaredCovariance> declared_covariance(const CompensationTable& table,
                                               const std::vector<Rig>& rigs,
                                               const std::vector<Run>& measured,
                                               const TableOptions& options) {
  std::vector<Run> runs;
  for (const Run& run : measured) runs.push_back(restate(run, options.stated));
  MDOF_TRY(const auto all, all_contributors(rigs, runs));
  DeclaredCovariance sum;
  if (all.empty()) return sum;
  sum.forward = sum.reverse = std::vector<Covariance5>(table.position_m.size(), Covariance5{});
  for (const auto& [name, parts] : all)
    for (const std::vector<PointShifts>& part : parts) {
      std::vector<Run> shifted = runs;
      for (std::size_t r = 0; r < runs.size(); ++r) shift(shifted[r].points, part[r]);
      MDOF_TRY(const MeanTable built, mean_table(shifted, options));
      add_products(built.table.forward, table.forward, sum.forward);
      add_products(built.table.reverse, table.reverse, sum.reverse);
    }
  return sum;
}

Status add_declared_uncertainty(CompensationTable& table, const std::vector<Rig>& rigs,
                                const std::vector<Run>& runs, const TableOptions& options) {
  MDOF_TRY(const DeclaredCovariance sum, declared_covariance(table, rigs, runs, options));
  if (sum.forward.empty()) return {};
  for (std::size_t k = 0; k < kErrorCount; ++k) {
    const std::size_t own = k * kErrorCount + k;
    table.u_declared[k].clear();
    for (std::size_t i = 0; i < table.position_m.size(); ++i)
      table.u_declared[k].push_back(std::sqrt(std::max(sum.forward[i][own], sum.reverse[i][own])));
  }
  return {};
}

}  // namespace mdof::algo
