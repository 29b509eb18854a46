#include "algo/sensitivity/kernels/kernels.h"

namespace mdof::algo {

const Kernels& kernels(InstructionSet set) {
  switch (set) {
    case InstructionSet::avx512:
      return kernels_avx512();
    case InstructionSet::avx2:
      return kernels_avx2();
    case InstructionSet::baseline:
      break;
  }
  return kernels_baseline();
}

}  // namespace mdof::algo
