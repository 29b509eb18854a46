#include "tools/mdof/study/running/checkpoint.h"

#include "schema/base/bytes.h"

namespace mdof::tools {
namespace {

constexpr std::string_view kMagic = "mdof study 1\n";

void put(std::string& to, const Convergence& convergence) {
  put_string(to, convergence.key);
  put_varint(to, convergence.points.size());
  for (const ConvergencePoint& p : convergence.points) {
    put_number(to, p.trials);
    for (const double x : {p.mean, p.sd, p.low, p.high}) put_number(to, x);
  }
}

void get(ByteReader& in, Convergence& convergence) {
  convergence.key = in.string();
  convergence.points.resize(in.count(5 * sizeof(double)));
  for (ConvergencePoint& p : convergence.points) {
    p.trials = in.number<std::uint64_t>();
    for (double* const x : {&p.mean, &p.sd, &p.low, &p.high}) *x = in.number<double>();
  }
}

using RuleBlock = std::vector<algo::BlockFigures>;

void put(std::string& to, const RuleBlock& block) {
  put_varint(to, block.size());
  for (const algo::BlockFigures& f : block) {
    put_number(to, f.n);
    for (const double x : {f.mean, f.u, f.low, f.high}) put_number(to, x);
  }
}

void get(ByteReader& in, RuleBlock& block) {
  block.resize(in.count(5 * sizeof(double)));
  for (algo::BlockFigures& f : block) {
    f.n = in.number<std::uint64_t>();
    for (double* const x : {&f.mean, &f.u, &f.low, &f.high}) *x = in.number<double>();
  }
}

// The first part of a checkpoint: all data except the statistics.
struct Head {
  std::uint64_t trials = 0;
  double elapsed_s = 0;
  algo::StudyScale scale;
  std::vector<Convergence> convergence;
  std::vector<RuleBlock> rule;
};

void get(ByteReader& in, Head& head) {
  head.trials = in.number<std::uint64_t>();
  head.elapsed_s = in.number<double>();
  head.scale.resize(in.count(2 * sizeof(double)));
  for (algo::OutputScale& scale : head.scale) {
    scale.low = in.number<double>();
    scale.width = in.number<double>();
  }
  head.convergence.resize(in.count(2));
  for (Convergence& convergence : head.convergence) get(in, convergence);
  head.rule.resize(in.count(1));
  for (RuleBlock& block : head.rule) get(in, block);
}

bool fits(const StudyWork& state, const std::vector<std::string>& outputs) {
  bool good = state.trials == state.statistics.trials();
  good &= state.convergence.size() == outputs.size();
  for (std::size_t k = 0; good && k < outputs.size(); ++k)
    good = state.convergence[k].key == outputs[k];
  for (const auto& block : state.rule) good &= block.size() == outputs.size();
  return good;
}

}  // namespace

StudyWork empty_work(const algo::Experiment& experiment, const algo::StudyScale& scale) {
  StudyWork work{0, 0, scale, algo::StudyStatistics(experiment, scale), {}, {}};
  for (const auto& key : experiment.outputs()) work.convergence.push_back({key, {}});
  return work;
}

void add_convergence(StudyWork& state, double coverage) {
  const auto summaries = state.statistics.overall({coverage, {}});
  for (std::size_t k = 0; k < summaries.size(); ++k) {
    const OutputSummary& s = summaries[k];
    state.convergence[k].points.push_back(
        {state.trials, s.mean, s.sd, s.symmetric.low, s.symmetric.high});
  }
}

std::string checkpoint_bytes(const StudyWork& state) {
  std::string bytes(kMagic);
  put_number(bytes, state.trials);
  put_number(bytes, state.elapsed_s);
  put_varint(bytes, state.scale.size());
  for (const algo::OutputScale& scale : state.scale) {
    put_number(bytes, scale.low);
    put_number(bytes, scale.width);
  }
  put_varint(bytes, state.convergence.size());
  for (const Convergence& convergence : state.convergence) put(bytes, convergence);
  put_varint(bytes, state.rule.size());
  for (const RuleBlock& block : state.rule) put(bytes, block);
  put_string(bytes, state.statistics.serialise());
  return bytes;
}

Result<StudyWork> parse_checkpoint(std::string_view bytes, const algo::Experiment& experiment) {
  ByteReader in(bytes);
  const bool ours = in.take(kMagic.size()) == kMagic;
  Head head;
  if (ours) get(in, head);
  const std::string_view statistics = in.string();
  if (!ours || !in.at_end() || head.scale.size() != experiment.outputs().size())
    return bad_input("the checkpoint has another version or is incomplete; run the study again");
  StudyWork state = empty_work(experiment, head.scale);
  MDOF_TRY(auto parsed, algo::StudyStatistics::parse(statistics, experiment));
  if (!parsed.matches(state.statistics))
    return bad_input("the checkpoint belongs to another experiment; run the study again");
  state.trials = head.trials;
  state.elapsed_s = head.elapsed_s;
  state.statistics = std::move(parsed);
  state.convergence = std::move(head.convergence);
  state.rule = std::move(head.rule);
  if (fits(state, experiment.outputs())) return state;
  return bad_input("the checkpoint is inconsistent; run the study again");
}

}  // namespace mdof::tools
