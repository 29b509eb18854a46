#include "tools/mdof/study/trial.h"

#include <utility>
#include <vector>

#include "schema/base/json_writer.h"
#include "tools/mdof/output.h"
#include "tools/mdof/text/json_text.h"

namespace mdof::tools {
namespace {

using Values = std::vector<std::pair<std::string, double>>;

Values preset_inputs(const Study& study, const algo::SimulationTrial& trial) {
  Values inputs{{"travel_mm", trial.travel_mm}};
  const auto& outputs = study.experiment->outputs();
  for (std::size_t k = 0; k < outputs.size(); ++k)
    inputs.emplace_back("truth." + outputs[k], trial.truth[k]);
  for (std::size_t k = 0; k < 5; ++k)
    inputs.emplace_back(std::string("probe.") + "ABCDE"[k] + ".turns", trial.probe_turns[k]);
  return inputs;
}

Result<Values> inputs_of(const Study& study, std::uint64_t trial) {
  if (study.scalable) return study.scalable->inputs(trial);
  MDOF_TRY(const auto parts, algo::simulation_trial(*study.preset, trial));
  return preset_inputs(study, parts);
}

Values outputs_of(const algo::Experiment& experiment, std::uint64_t trial) {
  std::vector<double> values(experiment.outputs().size());
  std::vector<double*> out;
  for (double& value : values) out.push_back(&value);
  experiment.run(trial, 1, 1, out);
  Values outputs;
  for (std::size_t k = 0; k < values.size(); ++k)
    outputs.emplace_back(experiment.outputs()[k], values[k]);
  return outputs;
}

void write(JsonWriter& json, const char* name, const Values& values) {
  json.key(name).begin_object();
  for (const auto& [key, value] : values) json.field(key, value);
  json.end_object();
}

}  // namespace

Status print_trial(const Study& study, std::uint64_t trial, bool as_json) {
  MDOF_TRY(const Values inputs, inputs_of(study, trial));
  JsonWriter json;
  json.begin_object().field("name", study.name).field("seed", *study.request.settings.seed);
  json.field("trial", trial);
  write(json, "inputs", inputs);
  write(json, "errors", outputs_of(*study.experiment, trial));
  json.end_object();
  return as_json ? write_line(json.text()) : write_out(readable(json.text()));
}

}  // namespace mdof::tools
