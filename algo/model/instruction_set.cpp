#include "algo/model/instruction_set.h"

namespace mdof::algo {

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
#if defined(__x86_64__)
  __builtin_cpu_init();
  if (__builtin_cpu_supports("avx512f")) return InstructionSet::avx512;
  if (__builtin_cpu_supports("avx2")) return InstructionSet::avx2;
#endif
  return InstructionSet::baseline;
}

std::vector<InstructionSet> available_instruction_sets() {
  std::vector<InstructionSet> sets = {InstructionSet::baseline};
  const InstructionSet best = best_instruction_set();
  if (best != InstructionSet::baseline) sets.push_back(InstructionSet::avx2);
  if (best == InstructionSet::avx512) sets.push_back(best);
  return sets;
}

}  // namespace mdof::algo
