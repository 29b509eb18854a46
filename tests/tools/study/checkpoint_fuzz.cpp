// Checkpoints of studies. If the first byte of the input is not 1, the input is a checkpoint. If
// it is 1, the other bytes are changes to a valid checkpoint. Each change has three bytes: two for
// the place, one for the value. It must be possible to continue an accepted checkpoint.
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstdlib>

#include "tools/mdof/study/running/checkpoint.h"

namespace {

using namespace mdof;

class TwoOutputs : public algo::Experiment {
 public:
  TwoOutputs() {
    outputs_ = {"EYX_um", "EAX_urad"};
    binned_ = {"travel_mm", 0, 1, 2};
  }
  void run(std::uint64_t first, std::uint64_t step, std::size_t n,
           std::span<double* const> out) const override {
    for (std::size_t j = 0; j < n; ++j) {
      const auto trial = static_cast<double>(first + step * j);
      out[0][j] = std::fmod(trial * 0.618, 1.0);
      out[1][j] = -trial;
    }
  }
};

std::string valid_checkpoint(const TwoOutputs& experiment) {
  auto work = tools::empty_work(experiment, algo::pilot_scale(experiment));
  work.trials = algo::block_trials(experiment, 2048);
  work.statistics.add_block(experiment, 0, work.trials);
  tools::add_convergence(work, 0.95);
  return tools::checkpoint_bytes(work);
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  static const TwoOutputs experiment;
  static const std::string good = valid_checkpoint(experiment);
  std::string bytes(reinterpret_cast<const char*>(data), size);
  if (size > 0 && data[0] == 1) {
    bytes = good;
    for (std::size_t i = 1; i + 2 < size; i += 3) {
      char& at = bytes[(data[i] * 256u + data[i + 1]) % bytes.size()];
      at = static_cast<char>(at ^ data[i + 2]);
    }
  }
  auto work = tools::parse_checkpoint(bytes, experiment);
  if (!work) {
    if (work.error().message.empty()) std::abort();
    return 0;
  }
  (void)tools::checkpoint_bytes(*work);
  tools::add_convergence(*work, 0.95);
  (void)work->statistics.bins();
  return 0;
}
