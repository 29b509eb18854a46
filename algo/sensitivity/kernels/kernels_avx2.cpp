#include "algo/sensitivity/kernels/chain_kernel.h"
#include "algo/sensitivity/kernels/moments_kernel.h"
#include "algo/sensitivity/kernels/simulation_kernel.h"

namespace mdof::algo {

const Kernels& kernels_avx2() {
  static constexpr Kernels kernels = {draw_pairs_kernel, simulate_kernel, scan_kernel,
                                      chain_kernel};
  return kernels;
}

}  // namespace mdof::algo
