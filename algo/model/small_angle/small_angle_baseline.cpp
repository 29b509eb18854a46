#include "algo/model/small_angle/small_angle_kernel.h"

namespace mdof::algo {

BatchKernels batch_kernels_baseline() {
  typedef double Vector __attribute__((vector_size(16)));
  return {solve_all<Vector, Model::simplified>, solve_all<Vector, Model::exact>};
}

}  // namespace mdof::algo
