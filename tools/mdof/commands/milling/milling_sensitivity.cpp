#include "tools/mdof/commands/milling/milling_sensitivity.h"

#include <algorithm>
#include <atomic>
#include <optional>

#include "algo/sensitivity/indices.h"
#include "algo/sensitivity/statistics/statistics.h"
#include "schema/base/number/number_text.h"
#include "tools/mdof/progress_bar.h"
#include "tools/mdof/study/running/divided_trials.h"
#include "tools/mdof/study/running/workers.h"
#include "tools/mdof/terminal.h"
#include "tools/mdof/text/text_table.h"

namespace mdof::tools {
namespace {

constexpr double kCoverage = 0.95;

bool go_on() {
  return true;
}

std::vector<OutputSummary> summaries(const algo::Experiment& trials,
                                     const MillingSensitivityRequest& request) {
  const DividedTrials divided(trials, request.threads, go_on);
  algo::StudyStatistics statistics(divided, algo::pilot_scale(divided, request.trials));
  statistics.add_block(divided, 0, request.trials);
  return statistics.overall({kCoverage, {0.5}});
}

std::vector<OutputIndices> indices_of(const algo::CausalExperiment& trials,
                                      const MillingSensitivityRequest& request) {
  const std::uint64_t each = std::min(algo::sum_block_trials(request.trials), algo::kSlowSumBlock);
  const std::uint64_t blocks = std::max<std::uint64_t>(2, request.trials / each);
  std::vector<std::optional<algo::SobolSums>> parts(std::max(1u, request.threads));
  std::atomic<std::uint64_t> finished = 0;
  ProgressBar bar("sensitivity");
  in_parallel(
      request.threads, blocks,
      [&](unsigned worker, std::size_t block) {
        if (!parts[worker]) parts[worker].emplace(trials, each);
        parts[worker]->add_block(trials, block);
        ++finished;
      },
      [&] {
        bar.show({static_cast<double>(finished), static_cast<double>(blocks), "blocks"});
        return true;
      });
  std::optional<algo::SobolSums> all;
  for (const auto& part : parts) {
    if (part && all) all->merge(*part);
    if (part && !all) all = part;
  }
  return all->result();
}

// Trials without a result, if there are any.
std::string dropped_text(const MillingSensitivityRequest& request,
                         const MillingSensitivity& found) {
  std::uint64_t dropped = 0;
  for (const OutputSummary& output : found.outputs) dropped = std::max(dropped, output.unsolved);
  if (dropped == 0) return "";
  return wrapped(std::to_string(dropped) + " of " + std::to_string(request.trials) +
                     " trials have no result, because their inputs do not describe a cut, or "
                     "because force and deflection have no equilibrium. u and shares do not "
                     "contain these trials",
                 terminal_columns()) +
         "\n";
}

const CauseIndex* index_of(const OutputIndices& output, const std::string& cause) {
  const auto found = std::find_if(output.causes.begin(), output.causes.end(),
                                  [&](const CauseIndex& c) { return c.cause == cause; });
  return found == output.causes.end() ? nullptr : &*found;
}

}  // namespace

Result<MillingSensitivity> find_milling_sensitivity(const DeclaredMillingPlan& declared,
                                                    const MillingSensitivityRequest& request) {
  MillingSensitivity found;
  found.inputs = algo::varying_inputs(declared);
  MDOF_TRY(found.effects, algo::milling_effects(declared.plan, found.inputs));
  const auto trials = algo::milling_trials(declared.plan, found.inputs, request.seed);
  found.outputs = summaries(*trials, request);
  found.indices = indices_of(*trials, request);
  return found;
}

void write_milling_sensitivity(JsonWriter& json, const MillingSensitivityRequest& request,
                               const MillingSensitivity& found) {
  json.key("sensitivity")
      .begin_object()
      .field("trials", request.trials)
      .field("seed", request.seed)
      .field("most_steps_per_turn", algo::kTrialStepsPerTurn)
      .key("outputs")
      .begin_object();
  for (const OutputSummary& output : found.outputs) {
    json.key(output.key).begin_object().field("mean", output.mean).field("u", output.sd);
    json.key("interval").begin_array().value(output.symmetric.low).value(output.symmetric.high);
    json.end_array().field("unsolved", output.unsolved).end_object();
  }
  json.end_object().key("inputs").begin_array();
  for (std::size_t i = 0; i < found.inputs.size(); ++i) {
    const algo::VaryingInput& input = found.inputs[i];
    json.begin_object()
        .field("name", input.input->name())
        .field("u", input.u / input.input->unit)
        .field("declared", input.declared);
    json.key("effect").begin_object();
    for (std::size_t k = 0; k < found.effects[i].size(); ++k)
      json.field(algo::milling_outputs()[k], found.effects[i][k]);
    json.end_object();
    for (const auto& [key, value, se] :
         {std::tuple("first", &CauseIndex::first, &CauseIndex::first_se),
          {"total", &CauseIndex::total, &CauseIndex::total_se}}) {
      json.key(key).begin_object();
      for (const OutputIndices& output : found.indices) {
        const CauseIndex* index = index_of(output, input.input->name());
        if (!index) continue;
        json.field(output.key, index->*value).field(output.key + "_se", index->*se);
      }
      json.end_object();
    }
    json.end_object();
  }
  json.end_array().end_object();
}

std::string milling_sensitivity_text(const MillingSensitivityRequest& request,
                                     const MillingSensitivity& found) {
  std::vector<std::string> head = {"effect of a change by u", "u"};
  for (const std::string& key : algo::milling_outputs()) head.push_back(key);
  TextTable effects(head);
  for (std::size_t i = 0; i < found.inputs.size(); ++i) {
    const algo::VaryingInput& input = found.inputs[i];
    std::vector<std::string> row = {
        input.input->name(),
        plain_number(input.u / input.input->unit, 3) + (input.declared ? "" : "*")};
    for (const double effect : found.effects[i]) row.push_back(fixed(effect, 4));
    effects.add(row);
  }
  std::vector<std::string> all = {"u from all inputs, Monte Carlo", ""};
  for (const OutputSummary& output : found.outputs) all.push_back(fixed(output.sd, 4));
  effects.add(all);
  head[0] = "share of variance/%";
  head.erase(head.begin() + 1);
  TextTable shares(head);
  for (const algo::VaryingInput& input : found.inputs) {
    std::vector<std::string> row = {input.input->name()};
    for (const OutputIndices& output : found.indices) {
      const CauseIndex* index = index_of(output, input.input->name());
      row.push_back(index ? with_u(fixed(100 * index->total, 1), fixed(100 * index->total_se, 1))
                          : "-");
    }
    shares.add(row);
  }
  std::string text = "\n" + effects.text(terminal_columns());
  if (std::any_of(found.inputs.begin(), found.inputs.end(),
                  [](const algo::VaryingInput& input) { return !input.declared; }))
    text += "* u is taken as 1 % of the value, because the plan declares no u of this input\n";
  return text + "\n" + shares.text(terminal_columns()) +
         wrapped("share: total Sobol index (with interactions) ± its standard error, from " +
                     std::to_string(request.trials) +
                     " trials; more trials (--trials) reduce the standard error",
                 terminal_columns()) +
         "\n" + dropped_text(request, found);
}

}  // namespace mdof::tools
