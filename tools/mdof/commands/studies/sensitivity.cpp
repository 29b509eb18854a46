// mdof sensitivity: calculates the effect of mounting errors on the measured errors by Monte Carlo.
//
//   rank 0 reads the request ─▶ all processes make the experiment ─▶ all run its trials ─▶ rank 0
//   makes the analyses of the plan, stores, draws and prints
#include <CLI/CLI.hpp>

#include "daemon/output/charts/study/study_plots.h"
#include "daemon/paths.h"
#include "daemon/words/error_text.h"
#include "tools/mdof/commands/command.h"
#include "tools/mdof/interrupt.h"
#include "tools/mdof/output.h"
#include "tools/mdof/study/analyses.h"
#include "tools/mdof/study/json.h"
#include "tools/mdof/study/output.h"
#include "tools/mdof/study/result.h"
#include "tools/mdof/study/running/processes.h"
#include "tools/mdof/study/running/recorder.h"
#include "tools/mdof/study/running/run_experiment.h"
#include "tools/mdof/study/running/runner.h"
#include "tools/mdof/study/sensitivity_options.h"
#include "tools/mdof/study/trial.h"

namespace mdof::tools {
namespace {

// The study in this process. Only rank 0 stores it in the database.
struct Job {
  Study study;
  StudyWork work;
  StudyRecorder recorder;
  std::string started_utc;
};

// The data that rank 0 reads from the command line and the database before the experiment is made.
struct Start {
  StudyRequest request;
  std::optional<StoredStudy> stored;  // the study to continue
};

Result<Start> start_of(const SensitivityCommand& command) {
  if (!command.plots.empty()) MDOF_CHECK(check_plot_folder(command.plots));
  if (!command.continued) {
    MDOF_TRY(StudyRequest request, request_of(command));
    return Start{std::move(request), std::nullopt};
  }
  MDOF_TRY(StoredStudy stored, study_to_continue(command.database, *command.continued));
  return Start{stored.request, std::move(stored)};
}

Result<StudyRequest> share(StudyRequest request, Processes& processes) {
  request.plan_toml = processes.broadcast(std::move(request.plan_toml));
  request.source = processes.broadcast(std::move(request.source));
  MDOF_TRY(request.settings, parse_settings(processes.broadcast(settings_toml(request.settings))));
  return request;
}

RunnerOptions runner_options(const SensitivityCommand& command, const Job& job) {
  const StudySettings& settings = job.study.request.settings;
  return {settings.trials,    settings.adaptive,
          *settings.coverage, command.threads,
          job.study.slow(),   [&job](const StudyWork& work) { job.recorder.checkpoint(work); }};
}

Status set_up_record(const SensitivityCommand& command, const std::optional<StoredStudy>& stored,
                     Job& job) {
  job.started_utc = stored ? stored->record.started_utc : daemon::utc_now();
  if (stored) {
    job.recorder = StudyRecorder(command.database, stored->record.id);
  } else if (!command.database.empty()) {
    MDOF_TRY(job.recorder, StudyRecorder::begin(command.database, job.study, job.started_utc));
  }
  return {};
}

Result<Job> make_job(Start start, unsigned threads, Processes& processes) {
  const auto& stored = start.stored;
  MDOF_TRY(StudyRequest request, share(std::move(start.request), processes));
  MDOF_TRY(Study study, make_study(std::move(request)));
  if (stored) {
    MDOF_TRY(StudyWork work, continued_work(*stored, study));
    return Job{std::move(study), std::move(work), {}, {}};
  }
  const auto trials = study.request.settings.trials.value_or(algo::kPilotTrials);
  const algo::Experiment& experiment = *study.experiment;
  const algo::StudyScale scale =
      study.slow()
          ? algo::pilot_scale(DividedTrials(experiment, threads, [] { return true; }), trials)
          : algo::pilot_scale(experiment, trials);
  StudyWork work = empty_work(experiment, scale);
  return Job{std::move(study), std::move(work), {}, {}};
}

Status draw(const SensitivityCommand& command, const StudyResult& result) {
  return command.plots.empty() ? Status() : charts::write_study_plots(result, command.plots);
}

// The key of an output for which no trial was solved; empty: no such output.
std::string unsolved_output(const StudyResult& result) {
  for (const OutputSummary& s : result.outputs)
    if (s.n == 0) return s.key;
  return "";
}

// The error that no trial was solved for this output. The message contains the reason of the first
// trial, if it is known.
Status not_solved(const Study& study, const std::string& key, std::uint64_t trials) {
  const Status first = study.slow() ? check_run_trial(*study.plan, 0) : Status();
  return fail(
      ErrorCode::check,
      key + ": none of the " + std::to_string(trials) + " trials gave a result; " +
          (first ? "show a trial with --trial 0" : "trial 0: " + words::text(first.error())));
}

// Exit code 1: there is a result, but not the requested one.
Status judge(const Study& study, const StudyResult& result, const StudyRecorder& recorder) {
  if (result.state == StudyState::complete) {
    const std::string key = unsolved_output(result);
    return key.empty() ? Status() : not_solved(study, key, result.trials);
  }
  return fail(
      ErrorCode::check,
      "interrupted after " + std::to_string(result.trials) + " trials; " +
          (recorder.id()
               ? "continue with " + recorder.continue_command()
               : std::string(
                     "the study cannot be continued, because it was started without --db FILE")));
}

Status finish(const SensitivityCommand& command, Job& job, StudyState state,
              const std::string& not_settled) {
  StudyResult result = result_of(job.study, job.work, job.started_utc);
  if (state == StudyState::complete && unsolved_output(result).empty()) {
    MDOF_TRY(state, analyse(job.study, command.threads, result));
  }
  result.state = state;
  if (state == StudyState::complete && !not_settled.empty()) result.warnings.push_back(not_settled);
  const std::string figures = study_figures_json(result);
  MDOF_CHECK(job.recorder.end(result, figures, job.work));
  for (const auto& warning : result.warnings) warn(warning);
  MDOF_CHECK(draw(command, result));
  MDOF_CHECK(print_study(result, figures, job.recorder.id(), command.form));
  return judge(job.study, result, job.recorder);
}

Status run_study(const SensitivityCommand& command, Processes& processes) {
  Result<Start> start = processes.first() ? start_of(command) : Start{};
  MDOF_CHECK(processes.agree(start ? Status() : tl::unexpected(start.error())));
  Result<Job> job = make_job(*start, command.threads, processes);
  MDOF_CHECK(processes.agree(job ? Status() : tl::unexpected(job.error())));
  Result<StudyRunner> runner =
      StudyRunner::create(*job->study.experiment, runner_options(command, *job), processes);
  Status ready = runner ? Status() : tl::unexpected(runner.error());
  if (ready && processes.first()) ready = set_up_record(command, start->stored, *job);
  MDOF_CHECK(processes.agree(ready));
  const Interrupt interrupt;
  const StudyState state = runner->run(job->work);
  return processes.first() ? finish(command, *job, state, runner->not_settled()) : Status();
}

Status show_trial(const SensitivityCommand& command, const Processes& processes) {
  if (!processes.first()) return {};
  MDOF_TRY(StudyRequest request, request_of(command));
  MDOF_TRY(const Study study, make_study(std::move(request)));
  return print_trial(study, *command.trial, command.form == StudyForm::json);
}

Status sensitivity(SensitivityCommand& command) {
  MDOF_TRY(Processes processes, Processes::join());
  Status done = check_usage(command);  // all processes have the same command line
  if (done) done = command.trial ? show_trial(command, processes) : run_study(command, processes);
  const bool is_reporting_rank = processes.first();
  processes.leave();
  // Only rank 0 returns the error, because mpirun ends all processes when one of them fails.
  return is_reporting_rank ? done : Status();
}

Action declare_sensitivity(CLI::App& command) {
  const auto o = std::make_shared<SensitivityCommand>();
  declare_options(command, *o);
  return [o] { return sensitivity(*o); };
}

}  // namespace

Command sensitivity_command() {
  return {.name = "sensitivity",
          .summary = "Find the effect of mounting errors on the measured errors (Monte Carlo)",
          .footer =
              "Examples:\n"
              "  mdof sensitivity --preset simulation-2 --radius-um 5 --plot plots\n"
              "  mdof sensitivity --plan plan.toml --adaptive --digits 2 --db studies.db\n"
              "  mpirun -n 8 mdof sensitivity --preset simulation-1 --trials 1e11 --json",
          .declare = declare_sensitivity};
}

}  // namespace mdof::tools
