#include "tools/mdof/study/running/study_request.h"

#include <cmath>
#include <filesystem>
#include <limits>

#include "schema/base/files.h"
#include "schema/base/json_writer.h"
#include "schema/base/number/number.h"
#include "schema/base/sha256.h"
#include "schema/base/toml/toml_reader.h"
#include "tools/mdof/study/preset.h"
#include "tools/mdof/study/running/run_experiment.h"

namespace mdof::tools {
namespace {

constexpr std::uint64_t kPresetTrials = 1'000'000;
constexpr std::size_t kFileLimit_bytes = std::size_t{16}
                                         << 20;  // largest size of a file with a sample

std::optional<std::uint64_t> natural(TomlTable& table, const char* key) {
  if (!table.has(key)) return std::nullopt;
  const std::int64_t x = table.integer(key);
  if (x < 0) table.reject(key, "must not be negative");
  return static_cast<std::uint64_t>(std::max<std::int64_t>(x, 0));
}

Status check(const StudySettings& settings) {
  if (settings.trials && *settings.trials == 0) return bad_input("trials: must be 1 or more");
  const double coverage = settings.coverage.value_or(0.95);
  if (!(coverage > 0 && coverage < 1))
    return bad_input("coverage: must lie between 0 and 1, such as 0.95");
  return {};
}

// Adds the settings of the plan to the settings of the command line, if the command line does not
// contain them.
void fill_in(StudySettings& settings, const StudyPlan& plan) {
  if (!settings.seed) settings.seed = plan.seed;
  if (!settings.coverage) settings.coverage = plan.coverage;
  if (!settings.adaptive && plan.adaptive && !settings.trials) {
    settings.adaptive.emplace();
    settings.adaptive->digits = plan.adaptive->digits;
    for (const auto& [key, value] : plan.adaptive->tolerances)
      settings.adaptive->absolute[key] = value;
  }
  if (!settings.trials && !settings.adaptive) settings.trials = plan.trials;
}

void fill_in(StudySettings& settings) {
  if (!settings.seed) settings.seed = 1;
  if (!settings.coverage) settings.coverage = 0.95;
  if (!settings.trials && !settings.adaptive) settings.trials = kPresetTrials;
}

Status make_preset(Study& study) {
  MDOF_TRY(Preset preset, parse_preset(study.request.plan_toml));
  fill_in(study.request.settings);
  preset.options.seed = *study.request.settings.seed;
  MDOF_TRY(study.experiment, algo::make_simulation(preset.options));
  study.name = preset.name;
  study.preset = preset.options;
  return {};
}

Status make_plan(Study& study) {
  MDOF_TRY(StudyPlan plan, parse_study_plan(study.request.plan_toml, study.request.source));
  fill_in(study.request.settings, plan);
  plan.seed = *study.request.settings.seed;
  plan.coverage = *study.request.settings.coverage;
  MDOF_TRY(auto experiment,
           plan.whole_run ? make_run_experiment(plan) : algo::make_plan_experiment(plan));
  study.scalable = experiment.get();
  study.experiment = std::move(experiment);
  study.name = plan.name;
  study.plan = std::move(plan);
  return {};
}

// The names of the rig and sample files in a plan. The plan is valid, because it was parsed before.
Result<std::vector<std::string>> named_files(const StudyRequest& request) {
  MDOF_TRY(TomlTable plan, TomlTable::parse(request.plan_toml, request.source));
  std::vector<std::string> files{plan.string("rig")};
  if (auto squareness = plan.table("squareness")) files.push_back(squareness->string("rig_y"));
  if (auto compare = plan.table("compare")) files.push_back(compare->string("rig"));
  for (TomlTable& quantity : plan.tables("quantity"))
    if (quantity.string("distribution") == "empirical") files.push_back(quantity.string("file"));
  return files;
}

std::string hash_of_first_trials(const algo::Experiment& experiment) {
  constexpr std::size_t kTrials = 64;
  const std::size_t outputs = experiment.outputs().size();
  std::vector<double> values(kTrials * outputs);
  std::vector<double*> out;
  for (std::size_t k = 0; k < outputs; ++k) out.push_back(values.data() + k * kTrials);
  experiment.run(0, 1, kTrials, out);
  for (double& x : values)
    if (std::isnan(x)) x = std::numeric_limits<double>::quiet_NaN();  // makes all NaNs equal
  return sha256_hex({reinterpret_cast<const char*>(values.data()), values.size() * sizeof(double)});
}

}  // namespace

std::string settings_toml(const StudySettings& settings) {
  std::string toml;
  const auto line = [&toml](const char* key, auto x) {
    JsonWriter value;
    toml += std::string(key) + " = " + value.value(x).text() + "\n";
  };
  if (settings.trials) line("trials", *settings.trials);
  if (settings.seed) line("seed", *settings.seed);
  if (settings.coverage) line("coverage", *settings.coverage);
  if (!settings.adaptive) return toml;
  line("digits", settings.adaptive->digits);
  JsonWriter list;
  list.begin_array();
  for (const auto& [key, tolerance] : settings.adaptive->absolute) {
    JsonWriter value;
    list.value(key + "=" + value.value(tolerance).text());
  }
  return toml + "tolerances = " + list.end_array().text() + "\n";
}

Result<StudySettings> parse_settings(const std::string& toml) {
  MDOF_TRY(TomlTable table, TomlTable::parse(toml, "settings"));
  StudySettings settings;
  settings.trials = natural(table, "trials");
  settings.seed = natural(table, "seed");
  if (table.has("coverage")) settings.coverage = table.number("coverage");
  const std::vector<std::string> tolerances = table.strings("tolerances");
  if (table.has("digits")) {
    settings.adaptive.emplace();
    settings.adaptive->digits = static_cast<int>(table.integer("digits"));
    for (const auto& tolerance : tolerances)
      MDOF_CHECK(add_tolerance(tolerance, *settings.adaptive));
  }
  MDOF_CHECK(table.finish());
  return settings;
}

Status add_tolerance(const std::string& key_value, algo::AdaptiveTolerance& tolerance) {
  const std::size_t equals = key_value.find('=');
  const char* const end = key_value.data() + key_value.size();
  double x = 0;
  const bool read =
      equals != std::string::npos && parse_double(key_value.data() + equals + 1, end, x) == end;
  if (!read || !std::isfinite(x) || x <= 0)
    return fail(ErrorCode::usage,
                "--tolerance: \"" + key_value +
                    "\" must be OUTPUT=NUMBER with a finite number above 0, such as EBX_urad=0.01");
  if (!tolerance.absolute.emplace(key_value.substr(0, equals), x).second)
    return fail(ErrorCode::usage, "--tolerance: " + key_value.substr(0, equals) +
                                      " is given twice; give only one value");
  return {};
}

Result<Study> make_study(StudyRequest request) {
  Study study;
  study.request = std::move(request);
  MDOF_CHECK(study.request.source.empty() ? make_preset(study) : make_plan(study));
  MDOF_CHECK(check(study.request.settings));
  return study;
}

Result<std::string> fingerprint(const Study& study) {
  std::string lines;
  if (study.plan) {
    MDOF_TRY(const auto files, named_files(study.request));
    const auto folder = std::filesystem::path(study.request.source).parent_path();
    for (const std::string& file : files) {
      MDOF_TRY(const std::string bytes, read_text_file(folder / file, kFileLimit_bytes));
      lines += sha256_hex(bytes) + "  " + file + "\n";
    }
  }
  return lines + hash_of_first_trials(*study.experiment) + "  " + kFirstTrials + "\n";
}

std::string changed_since(const std::string& before, const std::string& now) {
  for (std::size_t at = 0; at < now.size();) {
    const std::string line = now.substr(at, now.find('\n', at) + 1 - at);
    at += line.size();
    if (before.find(line) == std::string::npos) return line.substr(66, line.size() - 67);
  }
  return "";
}

}  // namespace mdof::tools
