#include "schema/base/instruction_set.h"

#include <cstdlib>
#include <optional>
#include <string>

namespace mdof {
namespace {

constexpr const char* kVariable = "MDOF_INSTRUCTION_SET";

InstructionSet best_of_processor() {
#if defined(__x86_64__)
  __builtin_cpu_init();
  if (__builtin_cpu_supports("avx512f")) return InstructionSet::avx512;
  if (__builtin_cpu_supports("avx2")) return InstructionSet::avx2;
#endif
  return InstructionSet::baseline;
}

// Returns the name in the environment variable; nullptr: no name.
const char* asked_for() {
  const char* const name = std::getenv(kVariable);
  return name && *name ? name : nullptr;
}

std::optional<InstructionSet> available(const std::string& name) {
  for (const InstructionSet set : available_instruction_sets())
    if (name == to_string(set)) return set;
  return std::nullopt;
}

}  // namespace

const char* to_string(InstructionSet set) {
  switch (set) {
    case InstructionSet::avx512:
      return "avx512";
    case InstructionSet::avx2:
      return "avx2";
    case InstructionSet::baseline:
      break;
  }
  return "baseline";
}

InstructionSet best_instruction_set() {
  static const InstructionSet kBest = [] {
    const char* const name = asked_for();
    return (name ? available(name) : std::nullopt).value_or(best_of_processor());
  }();
  return kBest;
}

std::vector<InstructionSet> available_instruction_sets() {
  std::vector<InstructionSet> sets = {InstructionSet::baseline};
  const InstructionSet best = best_of_processor();
  if (best != InstructionSet::baseline) sets.push_back(InstructionSet::avx2);
  if (best == InstructionSet::avx512) sets.push_back(best);
  return sets;
}

Status check_instruction_set() {
  const char* const name = asked_for();
  if (!name || available(name)) return {};
  std::string names;
  for (const InstructionSet set : available_instruction_sets())
    names += (names.empty() ? "" : ", ") + std::string(to_string(set));
  return bad_input(std::string(kVariable) + " is \"" + name +
                   "\", but this processor supports only " + names +
                   "; set the variable to one of these names, or unset the variable");
}

}  // namespace mdof
