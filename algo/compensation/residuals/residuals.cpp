#include "algo/compensation/residuals/residuals.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <string>
#include <tuple>
#include <utility>
#include <vector>

#include "algo/compensation/between_targets.h"
#include "algo/compensation/compensation.h"
#include "algo/iso230/line_fit.h"
#include "schema/base/number/number_text.h"
#include "schema/rig/correction.h"
#include "schema/units.h"

namespace mdof::algo {
namespace {

constexpr double kTargetWindowShare = 0.02;  // of the smaller interval beside the target
// Residuals with a larger share of the applied values are similar to them.
constexpr double kLargestShare = 0.75;
// The share is calculated if the applied values are larger than this number of u.
constexpr double kLeastInU = 4;

using SideColumns = std::array<std::vector<double>, 5>;

bool has_values(const SideColumns& columns) {
  return std::any_of(columns[0].begin(), columns[0].end(),
                     [](double value) { return std::isfinite(value); });
}

// For table_at(), which is otherwise slow.
CompensationTable with_curvatures(CompensationTable table) {
  add_curvatures(table);
  return table;
}

CorrectionSigns signs_of_table(const CompensationTable& table) {
  return correction_signs(table.machine, table.axis, table.sides, table.stated.reference);
}

Status check_same_set_up(const CompensationTable& applied, const CompensationTable& table) {
  const std::string name = "table " + std::to_string(applied.id);
  if (applied.axis != table.axis)
    return bad_input(name + " is for axis " + letter(applied.axis) +
                     ", but the runs measure axis " + letter(table.axis) +
                     "; give a table of the axis that the runs measure");
  if (applied.has_positioning())
    return bad_input(name +
                     " contains positioning errors, which the probes do not measure; give a table "
                     "that was built from measured runs");
  if (applied.sides != table.sides || applied.machine != table.machine ||
      applied.stated != table.stated)
    return bad_input(name +
                     " and the rig of the runs differ in at least one of moves, travel, [machine] "
                     "and the reference point; measure with the rig of the table");
  for (const auto& [of_applied, of_table, approach] :
       {std::tuple{&applied.forward, &table.forward, "forward"},
        std::tuple{&applied.reverse, &table.reverse, "reverse"}})
    if (has_values(*of_applied) != has_values(*of_table))
      return bad_input(std::string("the ") + approach + " approach is missing in " +
                       (has_values(*of_table) ? name : "the runs") +
                       "; the runs must contain the same approaches as the table");
  const CorrectionSigns signs = signs_of_table(applied);
  if (std::all_of(signs.factor.begin(), signs.factor.end(), [](int f) { return f == 0; }))
    return bad_input(name + " gives no correction (" + signs.gap[0] +
                     "), so the runs contain the whole errors, not only what a correction leaves; "
                     "build a new table from these runs alone");
  return {};
}

// Error: no target of `table` is at the position of a target of `applied`. The values that
// `applied` has there would be lost.
Status check_targets(const CompensationTable& applied, const CompensationTable& table) {
  const std::vector<double>& x = applied.position_m;
  for (std::size_t i = 0; i < x.size(); ++i) {
    const double interval_m =
        std::min(i > 0 ? x[i] - x[i - 1] : HUGE_VAL, i + 1 < x.size() ? x[i + 1] - x[i] : HUGE_VAL);
    if (std::none_of(table.position_m.begin(), table.position_m.end(), [&](double at) {
          return std::abs(at - x[i]) <= kTargetWindowShare * interval_m;
        }))
      return bad_input("the runs have no target at the position " + plain_number(to_mm(x[i]), 7) +
                       " mm, at which table " + std::to_string(applied.id) +
                       " has a value; measure at least at the targets of the table");
  }
  return {};
}

// The applied values that belong to the values of one side of `table`.
Result<SideColumns> applied_values(const CompensationTable& applied, const CompensationTable& table,
                                   TableSide side) {
  SideColumns values;
  for (const double at_m : table.position_m) {
    const TableValue value = table_at(applied, at_m, side);
    if (!value.inside)
      return bad_input("the runs have a target at " + plain_number(to_mm(at_m), 7) +
                       " mm, beyond the values of table " + std::to_string(applied.id) +
                       "; measure only within the range of the table");
    for (std::size_t k = 0; k < 5; ++k) values[k].push_back(value.error[k]);
  }
  return values;
}

// Refers the sum to its own least-squares line, and its angles to the first target, as a table is
// defined. The references of the two parts differ if their targets differ.
void refer_to_own_targets(CompensationTable& table) {
  for (std::size_t k = 0; k < 5; ++k) {
    std::vector<double> x, means;
    for (std::size_t i = 0; i < table.position_m.size(); ++i) {
      const double f = table.forward[k][i], r = table.reverse[k][i];
      const double mean = !std::isfinite(r) ? f : std::isfinite(f) ? (f + r) / 2 : r;
      if (!std::isfinite(mean)) continue;
      x.push_back(table.position_m[i]);
      means.push_back(mean);
    }
    Line reference;
    if (x.empty() || (!error_names(table.axis)[k].angle && !table.slope_removed)) continue;
    if (error_names(table.axis)[k].angle)
      reference.intercept = means.front();
    else if (can_fit(x))
      reference = least_squares_line(x, means);
    for (auto* side : {&table.forward, &table.reverse})
      for (std::size_t i = 0; i < table.position_m.size(); ++i)
        (*side)[k][i] -= reference.at(table.position_m[i]);
  }
}

// How similar residuals are to applied values: the share of the applied values that remained.
struct Similarity {
  double product = 0, square = 0, u_square = 0;
  void add(double residual, double applied, double u) {
    if (!std::isfinite(residual) || !std::isfinite(applied) || !std::isfinite(u)) return;
    product += residual * applied;
    square += applied * applied;
    u_square += u * u;
  }
  bool is_similar() const {
    return square > kLeastInU * kLeastInU * u_square && std::abs(product) > kLargestShare * square;
  }
  Notice notice(const char* error, const char* part, std::int64_t table) const {
    return mdof::notice(NoticeCode::residuals_like_table, error,
                        {{"part", part}, {"percent", 100 * product / square}, {"table", table}});
  }
};

}  // namespace

Status add_applied(const CompensationTable& stored, CompensationTable& table) {
  MDOF_CHECK(check_same_set_up(stored, table));
  MDOF_CHECK(check_targets(stored, table));
  const CompensationTable applied = with_curvatures(stored);
  const CorrectionSigns signs = signs_of_table(applied);
  for (const auto& [side, values] : {std::pair{TableSide::forward, &table.forward},
                                     std::pair{TableSide::reverse, &table.reverse}}) {
    if (!has_values(*values)) continue;
    MDOF_TRY(const SideColumns added, applied_values(applied, table, side));
    for (std::size_t k = 0; k < 5; ++k)
      for (std::size_t i = 0; i < added[k].size(); ++i)
        if (signs.factor[k] != 0) (*values)[k][i] += added[k][i];
  }
  refer_to_own_targets(table);
  table.simulated = table.simulated || applied.simulated;
  table.added_to = applied.id;
  return {};
}

Notices residual_notices(const CompensationTable& stored, const CompensationTable* earlier,
                         const CompensationTable& table) {
  const CompensationTable applied = with_curvatures(stored);
  const auto base = earlier ? std::optional(with_curvatures(*earlier)) : std::nullopt;
  Notices found;
  const CorrectionSigns signs = signs_of_table(applied);
  for (std::size_t k = 0; k < 5; ++k) {
    if (signs.factor[k] == 0) continue;
    Similarity values, reversal, added, added_reversal;
    for (std::size_t i = 0; i < table.position_m.size(); ++i) {
      const auto at = [&](const CompensationTable& of, TableSide side) {
        return table_at(of, table.position_m[i], side).error[k];
      };
      const double f = at(applied, TableSide::forward), r = at(applied, TableSide::reverse);
      const double u_f = table.u_of(table.u_forward, k, i), u_r = table.u_of(table.u_reverse, k, i);
      const double left_f = table.forward[k][i] - f, left_r = table.reverse[k][i] - r;
      const auto add = [&](double of_f, double of_r, Similarity& both, Similarity& difference) {
        both.add(left_f, of_f, u_f);
        both.add(left_r, of_r, u_r);
        difference.add(left_f - left_r, of_f - of_r, std::hypot(u_f, u_r));
      };
      add(f, r, values, reversal);
      if (base)
        add(f - at(*base, TableSide::forward), r - at(*base, TableSide::reverse), added,
            added_reversal);
    }
    for (const auto& [similarity, part] : {std::pair{&values, "errors"},
                                           {&reversal, "reversal errors"},
                                           {&added, "added errors"},
                                           {&added_reversal, "added reversal errors"}}) {
      if (!similarity->is_similar()) continue;
      found.push_back(similarity->notice(error_names(table.axis)[k].name, part, applied.id));
      break;
    }
  }
  return found;
}

}  // namespace mdof::algo
