#include "tools/mdof/stored/stated_results.h"

#include <algorithm>

#include "algo/iso230/straightness.h"
#include "daemon/measure/budgets.h"
#include "daemon/measure/evaluation.h"
#include "daemon/measure/gate/gate.h"
#include "schema/imported/series.h"
#include "tools/mdof/stored/run_choice.h"

namespace mdof::tools {

Result<charts::StatedResults> stated_results(store::Store& store, std::int64_t run,
                                             Reference reference) {
  charts::StatedResults results;
  MDOF_TRY(results.run, daemon::run_stated_at(store, run, reference));
  MDOF_CHECK(check_measured(results.run.header, "charts of its five errors"));
  daemon::StatedRun stated = daemon::stated_run(results.run);
  results.uncertainty = std::move(stated.points);
  results.figures = std::move(stated.figures);
  results.lines = algo::straightness_lines(results.run.header.moving(), results.run.points);
  results.marks = daemon::marks_of(results.run);
  return results;
}

Result<std::vector<std::int64_t>> run_numbers(store::Store& store,
                                              const std::vector<std::string>& words,
                                              const std::string& axis) {
  std::vector<std::int64_t> numbers;
  for (const std::string& word : words) {
    MDOF_TRY(const std::int64_t number, run_number(store, word, axis_from(axis)));
    if (std::find(numbers.begin(), numbers.end(), number) == numbers.end())
      numbers.push_back(number);
  }
  return numbers;
}

}  // namespace mdof::tools
