// mdof machine budget --preset co-planar | MACHINE.toml: calculates the uncertainty of the tool
// position, its causes, and the tolerances with which the error stays within a target.
#include <CLI/CLI.hpp>
#include <algorithm>

#include "tools/mdof/commands/command.h"
#include "tools/mdof/commands/machine/budget_output.h"
#include "tools/mdof/commands/machine/machine_file.h"
#include "tools/mdof/options.h"
#include "tools/mdof/output.h"
#include "tools/mdof/stored/database.h"
#include "tools/mdof/stored/run_choice.h"
#include "tools/mdof/study/running/workers.h"

namespace mdof::tools {
namespace {

constexpr double kMostTrials = 1e9, kMostSeed = 9e15;

struct MachineBudgetCommand {
  std::string file, preset, at, approach = "mean", database;
  std::vector<std::string> runs;
  std::int64_t trials = 1'000'000, seed = 1;
  std::optional<double> target_um;
  unsigned threads = default_threads();
  bool json = false;
};

std::vector<std::string> beyond_tables(const algo::BudgetModel& model) {
  std::vector<std::string> names;
  for (std::size_t i = 0; i < model.values.size(); ++i)
    for (std::size_t k = 0; k < kBodyErrors; ++k)
      if (model.values[i].beyond[k]) names.push_back(error_name(model.machine.frames[i], k));
  return names;
}

// Adds the runs that the options name, as if the machine file named them for their axes.
Status add_named_runs(Machine& machine, const MachineBudgetCommand& o) {
  if (o.runs.empty()) return {};
  MDOF_TRY(store::Store store, open_to_read(o.database));
  for (const std::string& word : o.runs) {
    MDOF_TRY(const std::int64_t id, run_number(store, word));
    MDOF_TRY(const RunHeader header, store.run_header(id));
    const std::string axis(1, letter(header.axis));
    const auto frame = std::find_if(machine.frames.begin(), machine.frames.end(),
                                    [&](const MachineFrame& f) { return f.id == axis; });
    if (frame == machine.frames.end())
      return bad_input("--run: the chain " + machine.chain.text + " has no axis " + axis +
                       "; give runs of axes of this chain");
    frame->runs.ids.push_back(id);
  }
  return {};
}

Status machine_budget(const MachineBudgetCommand& o) {
  if (o.file.empty() == o.preset.empty())
    return fail(ErrorCode::usage,
                "\"mdof machine budget\" needs either MACHINE.toml or --preset co-planar");
  Machine machine;
  MDOF_TRY(machine, o.file.empty() ? parse_machine(co_planar_machine(), o.preset)
                                   : described_machine(o.file));
  MDOF_CHECK(add_named_runs(machine, o));
  MDOF_CHECK(add_stored_errors(machine, o.database));
  BudgetRequest request;
  if (!o.at.empty()) {
    MDOF_TRY(request.at, command_from(machine, o.at));
  }
  request.approach = approach_from(o.approach);
  request.trials = static_cast<std::uint64_t>(o.trials);
  request.seed = static_cast<std::uint64_t>(o.seed);
  request.threads = o.threads;
  request.target_um = o.target_um;
  auto found = find_machine_budget(machine, request);
  if (!found) return in_context(o.file.empty() ? o.preset : o.file, std::move(found.error()));
  warn_outside_tables(beyond_tables(found->now.model));
  return o.json ? write_line(machine_budget_json(machine, request, *found))
                : write_out(machine_budget_text(machine, request, *found));
}

Action declare_machine_budget(CLI::App& command) {
  const auto o = std::make_shared<MachineBudgetCommand>();
  command
      .add_option("MACHINE", o->file, "MACHINE.toml with [[source]] tables or with measured errors")
      ->type_name("");
  command
      .add_option("--preset", o->preset, "Machine from the paper of Wang, Ye and Gunawan (2021)")
      ->check(CLI::IsMember({"co-planar"}));
  command
      .add_option("--at", o->at,
                  "Commanded positions in mm, such as X=10,Y=20 (rotary axes: degrees); the other "
                  "axes are at 0")
      ->type_name("X=…,Y=…");
  add_approach_option(command, o->approach);
  command
      .add_option("--run", o->runs,
                  "Stored run (number, or \"latest\"); the errors of the run replace the declared "
                  "sources of the same errors")
      ->check(run_argument_error)
      ->type_name("RUN");
  add_database_option(command, o->database);
  command.add_option("--trials", o->trials, "Number of trials")
      ->check(number_in(1000, kMostTrials))
      ->capture_default_str();
  command.add_option("--seed", o->seed, "Seed of the random numbers")
      ->check(number_in(0, kMostSeed))
      ->capture_default_str();
  command.add_option("--threads", o->threads, "Number of threads; the results do not depend on it")
      ->check(CLI::Range(1, 1024));
  command
      .add_option("--target-um", o->target_um,
                  "Length that 95 % of the error vectors must not exceed; mdof also prints the "
                  "largest permitted u of each source")
      ->check(positive_number());
  add_json_flag(command, o->json);
  return [o] { return machine_budget(*o); };
}

}  // namespace

Command machine_budget_command() {
  return {.name = "machine budget",
          .summary = "Calculate the error budget of a machine and show which error to reduce first",
          .footer =
              "mdof calculates u by linear propagation (GUM). It calculates intervals and the\n"
              "lengths of error vectors by Monte Carlo, with the exact product of rotations.\n"
              "Measured errors replace the declared sources of the same errors. The keys of\n"
              "MACHINE.toml are in share/doc/mdof/machine.md.\n"
              "Examples:\n"
              "  mdof machine budget --preset co-planar --at X=60,Y=40\n"
              "  mdof machine budget machine.toml --target-um 0.8\n"
              "  mdof machine budget machine.toml --run 1 --run 2",
          .declare = declare_machine_budget};
}

}  // namespace mdof::tools
