// Writes the section of a report on two runs of an axis, before and after a change of the axis.
#include "daemon/output/report/numbers.h"
#include "daemon/output/report/sections.h"
#include "daemon/words/words.h"
#include "schema/axis.h"
#include "schema/units.h"

namespace mdof::report {
namespace {

using output::Phrase;
using output::phrase;

Phrase effect_phrase(daemon::Effect effect) {
  return effect == daemon::Effect::reduced     ? Phrase::effect_reduced
         : effect == daemon::Effect::increased ? Phrase::effect_increased
         : effect == daemon::Effect::changed   ? Phrase::effect_changed
         : effect == daemon::Effect::unknown   ? Phrase::unknown
                                               : Phrase::effect_not_shown;
}

// Value and uncertainty of a budget in the unit of the figure's key.
std::string uncertain_text(const Budget& budget, const std::string& figure) {
  const bool angle = figure.ends_with("_urad");
  const auto shown = [&](double x) { return angle ? to_urad(x) : to_um(x); };
  return value_with_u(shown(budget.value), shown(budget.u)) + " (U\u00a0" +
         uncertainty_text(shown(budget.U)) + ")";
}

}  // namespace

void write_comparison(Html& html, const daemon::Comparison& comparison, Language language) {
  const auto of = [&](Phrase name) { return std::string(phrase(name, language)); };
  html.element(
      "h2", phrase(Phrase::before_and_after, language, {std::string(1, letter(comparison.axis))}));
  std::vector<std::vector<std::string>> rows;
  std::vector<Budget> changes;
  for (const daemon::ComparedFigure& figure : comparison.figures) {
    const std::string& key = figure.change.figure;
    rows.push_back({key.substr(0, key.rfind('_')), key_unit(key),
                    uncertain_text(figure.before, key), uncertain_text(figure.after, key),
                    uncertain_text(figure.change, key), of(effect_phrase(figure.effect))});
    changes.push_back(figure.change);
  }
  html.table({of(Phrase::figure), of(Phrase::unit),
              phrase(Phrase::before_run, language, {std::to_string(comparison.before)}),
              phrase(Phrase::after_run, language, {std::to_string(comparison.after)}),
              of(Phrase::change), of(Phrase::effect)},
             rows, "numbers");
  html.element("p", of(Phrase::change_explained));
  html.element("p", phrase(Phrase::u_covers, language, {words::text(covers(changes), language)}));
  for (const Notice& each : comparison.differences) html.element("p", words::text(each, language));
}

}  // namespace mdof::report
