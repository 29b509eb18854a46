#include "schema/uncertainty/budget.h"

#include <cmath>

namespace mdof {

std::string covers_text(const Budget& budget) {
  return budget.noise_only ? "noise and repeatability only: no uncertainties are declared"
                           : "noise, repeatability and what is declared";
}

const char* to_string(Conformity conformity) {
  return conformity == Conformity::conform       ? "conform"
         : conformity == Conformity::not_conform ? "not conform"
                                                 : "undecided";
}

Conformity conformity(const Budget& budget, double limit) {
  const double size = std::abs(budget.value);
  if (size + budget.U <= limit) return Conformity::conform;
  if (size - budget.U > limit) return Conformity::not_conform;
  return Conformity::undecided;  // and where nothing is known: NaN
}

}  // namespace mdof
