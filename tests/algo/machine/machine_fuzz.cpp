// MACHINE.toml: read or refused with a reason; the tool's error of a machine that was read is
// finite wherever its axes are. Files that it names are not read.
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstdlib>

#include "algo/machine/tool_error.h"

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
  }
  return 0;
}
