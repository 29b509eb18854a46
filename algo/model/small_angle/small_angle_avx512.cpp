#include "algo/model/small_angle/small_angle_kernel.h"

namespace mdof::algo {

BatchKernels batch_kernels_avx512() {
  typedef double Vector __attribute__((vector_size(64)));
  return {solve_all<Vector, Model::simplified>, solve_all<Vector, Model::exact>};
}

}  // namespace mdof::algo
