#include "schema/compensation_table.h"

#include <algorithm>

#include "schema/uncertainty/budget.h"

namespace mdof {

bool CompensationTable::noise_only() const {
  if (!has_declared()) return true;
  if (has_positioning() || not_declared.empty()) return false;
  for (const auto* u_random : {&u_forward, &u_reverse})
    for (std::size_t k = 0; k < u_declared.size(); ++k)
      for (std::size_t i = 0; i < position_m.size(); ++i)
        if (!is_noise_only(u_of(*u_random, k, i), u_declared[k][i])) return false;
  return true;
}

std::string covers_text(const CompensationTable& table) {
  if (table.has_positioning())
    return table.has_declared() ? "repeatability and what was declared at import"
                                : "repeatability only";
  if (!table.noise_only()) return "noise, repeatability and what the rigs declare";
  return table.has_declared() ? "noise and repeatability only: what the rigs declare adds nothing"
                              : "noise and repeatability only";
}

void add_not_declared(CompensationTable& table, const std::vector<std::string>& keys) {
  for (const std::string& key : keys)
    if (std::find(table.not_declared.begin(), table.not_declared.end(), key) ==
        table.not_declared.end())
      table.not_declared.push_back(key);
}

}  // namespace mdof
