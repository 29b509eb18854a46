#include "algo/uncertainty/effects/model_contributor.h"

#include <utility>
#include <vector>

#include "algo/model/restate.h"
#include "algo/model/solver.h"

namespace mdof::algo {
namespace {

PointShifts left_out(const Solver& simplified, const Solver& exact, const Run& run) {
  PointShifts shifts(run.points.size());
  for (std::size_t j = 0; j < shifts.size(); ++j) {
    const MeasuredPoint& p = run.points[j];
    const AxisErrors first = solved(simplified, p.point, run.header.moving(), run.header.stated);
    const AxisErrors all = solved(exact, p.point, run.header.moving(), run.header.stated);
    if (!p.errors.valid || !first.valid || !all.valid) continue;
    for (std::size_t e = 0; e < kErrorCount; ++e) shifts[j][e] = first.local[e] - all.local[e];
  }
  return shifts;
}

}  // namespace

std::optional<Contributor> model_contributor(const Rig& rig, const Run& run, Model model) {
  if (model != Model::simplified) return std::nullopt;
  const auto simplified = Solver::create(rig, Model::simplified);
  const auto exact = Solver::create(rig, Model::exact);
  if (!simplified || !exact)
    return std::nullopt;  // then no point of the run was solved with the
                          // model
  DeclaredUncertainty whole;
  whole.u = 1;
  std::vector<PointShifts> parts{left_out(*simplified, *exact, run)};
  return Contributor{{ContributorKind::simplified_model},         "", whole, 1, "",
                     [parts = std::move(parts)] { return parts; }};
}

}  // namespace mdof::algo
