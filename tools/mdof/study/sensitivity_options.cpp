#include "tools/mdof/study/sensitivity_options.h"

#include <unistd.h>

#include <CLI/CLI.hpp>
#include <array>
#include <cmath>
#include <filesystem>

#include "schema/base/files.h"
#include "schema/study/plan.h"
#include "tools/mdof/options.h"
#include "tools/mdof/study/preset.h"
#include "tools/mdof/study/running/workers.h"

namespace mdof::tools {
namespace {

namespace fs = std::filesystem;

constexpr std::uint64_t kLargestSeed = (std::uint64_t{1} << 63) - 1;  // limit of SQLite and TOML
constexpr double kMostTrials = 1e15;
constexpr double kLongest_m = 10;     // limit of each length, also of the travel
constexpr double kWidest_mrad = 250;  // limit of the models for small angles

std::string option_name(std::string key) {
  std::replace(key.begin(), key.end(), '_', '-');
  return "--" + key;
}

void declare_preset(CLI::App& command, SensitivityCommand& o) {
  const std::string group = "Parameters of a preset";
  for (const PresetNumber& number : preset_numbers()) {
    command.add_option(option_name(number.key), o.numbers[number.key], number.help)
        ->group(group)
        ->type_name("X");
  }
  command
      .add_option("--travel-mm", o.travel_mm,
                  "Range of the positions (uniform distribution between FROM and TO)")
      ->expected(2)
      ->group(group)
      ->type_name("FROM TO");
  command
      .add_option("--bins", o.bins,
                  "Divide the travel into N equal bins, and also print the results of each bin")
      ->check(CLI::Range(1, static_cast<int>(kMostStudyBins)))
      ->group(group)
      ->type_name("N");
}

void declare_trials(CLI::App& command, SensitivityCommand& o) {
  command
      .add_option("--trials", o.trials,
                  "Number of trials; if --adaptive is given, the largest number of trials")
      ->type_name("N");
  command
      .add_option("--seed", o.seed, "Seed of the random numbers [default: 1, or as in the plan]")
      ->check(CLI::Range(std::uint64_t{0}, kLargestSeed))
      ->type_name("S");
  command
      .add_option("--coverage", o.coverage,
                  "Coverage probability of the intervals [default: 0.95, or as in the plan]")
      ->type_name("P");
  auto* adaptive = command.add_flag(
      "--adaptive", o.adaptive,
      "Run trials until the results are stable within --tolerance or --digits (JCGM 101, 7.9)");
  command
      .add_option("--digits", o.digits,
                  "Number of significant digits of each standard deviation that must be stable "
                  "(JCGM 101, 7.9) [default: 2]")
      ->needs(adaptive)
      ->type_name("N");
  command
      .add_option("--tolerance", o.tolerances,
                  "Numerical tolerance of the results of one output, such as EBX_urad=0.01")
      ->needs(adaptive)
      ->type_name("KEY=VALUE");
  command
      .add_option("--trial", o.trial, "Show only the random numbers and the results of this trial")
      ->check(number_in(0, kMostTrials))
      ->type_name("INDEX");
  o.threads = default_threads();
  command.add_option("--threads", o.threads, "Number of threads; the results do not depend on it")
      ->check(CLI::Range(1, 1024))
      ->capture_default_str()
      ->type_name("T");
}

void declare_results(CLI::App& command, SensitivityCommand& o) {
  command
      .add_option("--db", o.database,
                  "Store the study in this database, so that the study can be continued later")
      ->type_name("FILE");
  command.add_option("--plot", o.plots, "Draw histograms and other charts as SVG in this folder")
      ->type_name("DIR");
  add_json_flag(command, o.json);
  command.add_flag("--csv", o.csv, "Print CSV with one row for each output and bin of the travel");
}

// The limit of an option whose name ends with `ending`.
struct Limit {
  const char *ending, *unit;
  double most;
  const char* why;
};

constexpr std::array kLimits = {
    Limit{"-um", " µm", kLongest_m * 1e6, "the length exceeds 10 m"},
    Limit{"-mm", " mm", kLongest_m * 1e3, "the length exceeds 10 m"},
    Limit{"-mrad", " mrad", kWidest_mrad, "the angle exceeds 0.25 rad, the limit for small angles"},
    Limit{"-urad", " µrad", kWidest_mrad * 1e3,
          "the angle exceeds 0.25 rad, the limit for small angles"},
};

Status check_number(const std::string& option, double x) {
  if (!std::isfinite(x)) return fail(ErrorCode::usage, option + ": must be a finite number");
  for (const Limit& limit : kLimits) {
    if (!option.ends_with(limit.ending) || std::abs(x) <= limit.most) continue;
    return fail(ErrorCode::usage, option + ": " + limit.why + "; give a value within ±" +
                                      std::to_string(std::llround(limit.most)) + limit.unit);
  }
  return {};
}

Result<algo::SimulationOptions> preset_options(const SensitivityCommand& command) {
  MDOF_TRY(auto options, preset_defaults(command.preset));
  for (const PresetNumber& number : preset_numbers()) {
    const auto& given = command.numbers.at(number.key);
    if (!given) continue;
    MDOF_CHECK(check_number(option_name(number.key), *given));
    options.*number.member = *given;
  }
  for (const double x : command.travel_mm) MDOF_CHECK(check_number("--travel-mm", x));
  if (!command.travel_mm.empty()) {
    options.travel_from_mm = command.travel_mm[0];
    options.travel_to_mm = command.travel_mm[1];
  }
  if (command.bins) options.travel_bins = *command.bins;
  return options;
}

bool any_of_preset(const SensitivityCommand& command) {
  for (const auto& [key, value] : command.numbers)
    if (value) return true;
  return !command.travel_mm.empty() || command.bins;
}

bool any_setting(const SensitivityCommand& command) {
  return command.trials || command.seed || command.coverage || command.adaptive || command.trial;
}

Status check_trials(const std::optional<double>& trials) {
  if (!trials) return {};
  if (*trials >= 1 && *trials <= kMostTrials && *trials == std::floor(*trials)) return {};
  return fail(ErrorCode::usage, "--trials: must be a whole number from 1 to 1e15");
}

Status check_coverage(const std::optional<double>& coverage) {
  if (!coverage || (*coverage > 0 && *coverage < 1)) return {};
  return fail(ErrorCode::usage, "--coverage: must lie between 0 and 1, such as 0.95");
}

Result<StudySettings> settings_of(const SensitivityCommand& command) {
  StudySettings settings;
  if (command.trials) settings.trials = static_cast<std::uint64_t>(*command.trials);
  settings.seed = command.seed;
  settings.coverage = command.coverage;
  if (command.adaptive) {
    algo::AdaptiveTolerance adaptive;
    if (command.digits) adaptive.digits = *command.digits;
    for (const auto& tolerance : command.tolerances) MDOF_CHECK(add_tolerance(tolerance, adaptive));
    settings.adaptive = std::move(adaptive);
  }
  return settings;
}

}  // namespace

void declare_options(CLI::App& command, SensitivityCommand& o) {
  command
      .add_option("--preset", o.preset,
                  "Simulation published by Kweon, Liu and Yang: simulation-1 or simulation-2")
      ->type_name("NAME");
  command
      .add_option("--plan", o.plan,
                  "Plan file of your own study (its keys: share/doc/mdof/sensitivity.md)")
      ->type_name("PLAN.toml");
  command
      .add_option("--continue", o.continued,
                  "Number of the stored study to continue (see mdof studies)")
      ->type_name("STUDY");
  declare_trials(command, o);
  declare_results(command, o);
  declare_preset(command, o);
}

Status check_usage(SensitivityCommand& command) {
  const int sources = (command.preset.empty() ? 0 : 1) + (command.plan.empty() ? 0 : 1) +
                      (command.continued ? 1 : 0);
  if (sources != 1)
    return fail(ErrorCode::usage,
                "sensitivity: give exactly one of --preset, --plan and --continue");
  if (command.preset.empty() && any_of_preset(command))
    return fail(ErrorCode::usage,
                "sensitivity: options such as --radius-um apply only to --preset; leave them out, "
                "because a plan or a stored study has its own parameters");
  if (command.continued && any_setting(command))
    return fail(ErrorCode::usage,
                "sensitivity: a continued study keeps the original trials, seed, coverage and "
                "adaptive rule; leave out the options for these settings");
  if (command.json && command.csv)
    return fail(ErrorCode::usage, "sensitivity: give --json or --csv, not both");
  command.form = command.json ? StudyForm::json : command.csv ? StudyForm::csv : StudyForm::text;
  MDOF_CHECK(check_coverage(command.coverage));
  return check_trials(command.trials);
}

Result<StudyRequest> request_of(const SensitivityCommand& command) {
  MDOF_TRY(StudySettings settings, settings_of(command));
  if (command.plan.empty()) {
    MDOF_TRY(const auto options, preset_options(command));
    return StudyRequest{preset_toml(command.preset, options), "", std::move(settings)};
  }
  MDOF_TRY(std::string plan_toml, read_text_file(command.plan));
  return StudyRequest{std::move(plan_toml), command.plan, std::move(settings)};
}

Status check_plot_folder(const std::string& folder) {
  std::error_code ec;
  fs::create_directories(folder, ec);
  const std::string why = ec ? ec.message() : "it is not a folder";
  if (ec || !fs::is_directory(folder, ec))
    return io_error(folder + ": the folder for plots cannot be created: " + why +
                    "; give another folder");
  if (::access(folder.c_str(), W_OK | X_OK) == 0) return {};
  return io_error(
      folder +
      ": plots cannot be written to this folder; make the folder writable, or give another folder");
}

}  // namespace mdof::tools
