// Fuzzer for MACHINE.toml. The parser must read the text or refuse it with a reason. For a machine
// that was read, the tool error must be finite at any position of the axes. Each trial of the
// budget must be finite, or the budget must be refused. Files that the text names are not read.
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstdlib>

#include "algo/machine/budget/trials.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace mdof;
  const std::string_view text(reinterpret_cast<const char*>(data), size);
  const auto machine = parse_machine(text, "fuzz.toml");
  if (!machine) {
    if (machine.error().message.empty()) std::abort();
    return 0;
  }
  for (const MachineFrame& frame : machine->frames) {
    if (!frame.file.empty()) return 0;
    for (const ErrorFunction& error : frame.error)
      if (!error.file.empty()) return 0;
  }
  for (const double at : {0.0, -0.1, 1.0}) {
    algo::Command command{};
    command.fill(at);
    const auto error = algo::tool_error(*machine, command, algo::MachineApproach::mean);
    if (!error.exact.allFinite() || !error.linear.allFinite()) std::abort();
    const auto model = algo::budget_model(*machine, command, algo::MachineApproach::mean,
                                          algo::BudgetStage::measured);
    if (!model) continue;
    double out[4] = {};
    double* const places[4] = {&out[0], &out[1], &out[2], &out[3]};
    algo::budget_trials(*model, 1)->run(0, 1, 1, places);
    for (const double x : out)
      if (!std::isfinite(x)) std::abort();
  }
  return 0;
}
