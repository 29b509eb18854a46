#include "schema/compensation_table.h"

#include <algorithm>
#include <cmath>
#include <span>

#include "schema/base/canonical.h"
#include "schema/base/sha256.h"
#include "schema/uncertainty/budget.h"

namespace mdof {

bool CompensationTable::noise_only() const {
  if (!has_declared()) return true;
  if (has_positioning() || not_declared.empty()) return false;
  if (!rigs_declare) return true;  // u_declared is that of removed drifts
  for (const auto* u_random : {&u_forward, &u_reverse})
    for (std::size_t k = 0; k < u_declared.size(); ++k)
      for (std::size_t i = 0; i < position_m.size(); ++i)
        if (!is_noise_only(u_of(*u_random, k, i), u_declared[k][i])) return false;
  return true;
}

std::string table_sha256(const CompensationTable& t) {
  using canonical::put;
  using canonical::put_counted;
  std::string bytes;
  const auto put_text = [&](std::string_view text) { put(bytes, text); };
  put_text("mdof table 2");
  const char axis = letter(t.axis);
  put_text({&axis, 1});
  put(bytes, t.simulated ? 1 : 0);
  put(bytes, t.slope_removed ? 1 : 0);
  put(bytes, std::uint64_t{t.runs.size()});
  for (const std::int64_t run : t.runs) put(bytes, run);
  if (t.added_to) {
    put_text("added to");
    put(bytes, *t.added_to);
  }
  put_text(t.sides.moves());
  put_text(t.sides.travel());
  put_text(t.machine.text);
  put_text(chain_travels_text(t.machine));
  put_text(to_string(t.stated.reference));
  put(bytes, std::span<const double>(t.stated.point_m));
  put_counted(bytes, t.position_m);
  for (const auto* group : {&t.forward, &t.reverse, &t.u_forward, &t.u_reverse, &t.u_declared})
    for (const auto& series : *group) put_counted(bytes, series);
  const PositioningErrors& along = t.positioning;
  for (const auto* series :
       {&along.forward, &along.reverse, &along.u_forward, &along.u_reverse, &along.u_declared})
    put_counted(bytes, *series);
  return sha256_hex(bytes);
}

namespace {

// Whether no target was measured twice with the same approach.
bool has_single_readings(const PositioningErrors& along) {
  const auto unknown = [](double u_random) { return std::isnan(u_random); };
  return std::all_of(along.u_forward.begin(), along.u_forward.end(), unknown) &&
         std::all_of(along.u_reverse.begin(), along.u_reverse.end(), unknown);
}

}  // namespace

Covers covers(const CompensationTable& table) {
  if (table.has_positioning() && table.has_declared() && has_single_readings(table.positioning))
    return {Covered::declared_at_import, Covered::no_repeatability};
  if (table.has_positioning())
    return {table.has_declared() ? Covered::repeatability_import : Covered::repeatability_only};
  return covers({.noise_only = table.noise_only(),
                 .declares = table.has_declared() && table.rigs_declare,
                 .repeated = !table.visited_once});
}

void add_declarations(CompensationTable& table, const Rig& rig) {
  table.rigs_declare = table.rigs_declare || rig.declares_uncertainty();
  for (const std::string& key : rig.undeclared_uncertainties())
    if (std::find(table.not_declared.begin(), table.not_declared.end(), key) ==
        table.not_declared.end())
      table.not_declared.push_back(key);
}

}  // namespace mdof
