#include "tools/mdof/study/running/runner.h"

#include <algorithm>
#include <atomic>
#include <bit>
#include <cassert>
#include <cmath>
#include <cstring>

#include "tools/mdof/interrupt.h"
#include "tools/mdof/study/running/workers.h"

namespace mdof::tools {
namespace {

constexpr std::chrono::seconds kCheckpoint{30};
constexpr double kRound_s = 2;  // largest delay after an interrupt with several processes

std::uint64_t rounded_up(std::uint64_t a, std::uint64_t b) {
  return a / b + (a % b == 0 ? 0 : 1);
}

}  // namespace

Result<StudyRunner> StudyRunner::create(const algo::Experiment& experiment, RunnerOptions options,
                                        Processes& processes) {
  if (!options.adaptive) {
    const std::uint64_t batch_trials =
        options.slow ? algo::block_trials(experiment, 1) : algo::block_trials(experiment);
    return StudyRunner(experiment, std::move(options), batch_trials, processes);
  }
  MDOF_TRY(const std::uint64_t batch_trials,
           algo::adaptive_block_trials(experiment, options.coverage));
  MDOF_TRY(auto rule, algo::AdaptiveRule::create(experiment.outputs(), *options.adaptive));
  StudyRunner runner(experiment, std::move(options), batch_trials, processes);
  runner.rule_ = std::move(rule);
  return runner;
}

StudyRunner::StudyRunner(const algo::Experiment& experiment, RunnerOptions options,
                         std::uint64_t batch_trials, Processes& processes)
    : experiment_(&experiment),
      options_(std::move(options)),
      processes_(&processes),
      batch_trials_(batch_trials) {
  if (options_.slow) {
    // With several processes, all of them must end a round at the same batch.
    const bool alone = processes.size() == 1;
    divided_ = std::make_unique<DividedTrials>(
        experiment, options_.threads, [alone] { return !alone || !Interrupt::requested(); });
    experiment_ = divided_.get();
    options_.threads = 1;
  }
  if (!options_.trials) return;
  total_ = rounded_up(*options_.trials, batch_trials_);
  expected_batches_ = static_cast<double>(*options_.trials) / static_cast<double>(batch_trials_);
}

StudyState StudyRunner::run(StudyWork& state) {
  resume(state);
  for (;;) {
    Round round = next_round();
    if (round.begin == round.end) break;
    work(round, state);
    stop_ = processes_->any(Interrupt::requested());
    if (!round.collect) continue;
    collect(state);
    note_convergence(state);
    checkpoint(state);
  }
  collect(state);
  bar_.reset();
  const bool complete = processes_->broadcast_number(done_ == total_ || rule_ended()) == 1;
  return complete ? StudyState::complete : StudyState::interrupted;
}

void StudyRunner::resume(const StudyWork& state) {
  begin_ = Clock::now();
  next_checkpoint_ = begin_ + kCheckpoint;
  elapsed_before_s_ = state.elapsed_s;
  if (rule_)
    for (const auto& block : state.rule) rule_->add(block);
  done_ = processes_->broadcast_number(rounded_up(state.trials, batch_trials_));
  if (processes_->first())
    bar_ = std::make_unique<ProgressBar>("study", static_cast<double>(state.trials));
}

// The batches of the next round; rank 0 decides for all processes. Rounds end after 1, 2, 4, 8 ...
// batches, where the convergence is recorded, or earlier if they would take too long.
StudyRunner::Round StudyRunner::next_round() {
  Round round{done_, done_, false};
  if (!stop_ && done_ != total_ && !rule_ended()) {
    round.end = std::min(std::bit_ceil(done_ + 1), done_ + longest_round());
    if (total_) round.end = std::min(round.end, *total_);
  }
  round.collect =
      std::has_single_bit(round.end) || round.end == total_ || Clock::now() > next_checkpoint_;
  round.end = processes_->broadcast_number(round.end);
  round.collect = processes_->broadcast_number(round.collect ? 1 : 0) == 1;
  return round;
}

// Whether the adaptive rule ends the study: its tolerances are met, or more trials would not help
// for one output.
bool StudyRunner::rule_ended() const {
  return rule_ && (rule_->settled() || rule_->unsettled_output());
}

std::string StudyRunner::not_settled() const {
  if (!rule_ || rule_->settled()) return "";
  const std::string what = "the requested tolerance of the results was not reached";
  const auto output = rule_->unsettled_output();
  if (!output) return what + " within the permitted number of trials; give a larger --trials";
  return what + ": a block of " + std::to_string(batch_trials_) +
         " trials gave fewer than two values of " + experiment_->outputs()[*output] +
         "; to calculate the other outputs, give --trials N without --adaptive";
}

// The largest number of batches in a round. With slow trials, it is one batch for each process,
// because an interrupted batch is lost. With the adaptive rule it is limited, because the rule may
// end the study within the round, and the trials after this point are lost.
std::uint64_t StudyRunner::longest_round() const {
  const auto size = static_cast<std::uint64_t>(processes_->size());
  if (divided_) return size;
  const auto in_time = std::max(size, static_cast<std::uint64_t>(batches_per_s_ * kRound_s));
  return rule_ ? std::min(in_time, std::max(options_.threads * size, done_ / 8)) : in_time;
}

void StudyRunner::work(Round& round, StudyWork& state) {
  const auto begin = Clock::now();
  Parts parts(options_.threads);
  Figures figures(rule_ ? round.end - round.begin : 0);
  round.end = work_share(round, parts, rule_ ? &figures : nullptr, state);
  if (rule_) {
    figures.resize(round.end - round.begin);
    const std::uint64_t settled_at = feed_rule(round, std::move(figures), state);
    if (settled_at < round.end) {  // discard the batches after the end by the rule
      round.end = settled_at;
      parts = Parts(options_.threads);
      work_share(round, parts, nullptr, state);
    }
  }
  for (const auto& part : parts)
    if (part) state.statistics.merge(*part);
  const double seconds = std::chrono::duration<double>(Clock::now() - begin).count();
  batches_per_s_ = static_cast<double>(round.end - round.begin) / std::max(seconds, 1e-6);
  done_ = round.end;
}

// Runs the batches of this process, adds them to `parts`, and stores the figures of each batch.
// Returns the number of the first batch that was not done. This is the end of the round, or an
// earlier batch if there is only one process and the user interrupted.
std::uint64_t StudyRunner::work_share(const Round& round, Parts& parts, Figures* figures,
                                      StudyWork& state) {
  const std::uint64_t at_once = figures ? 1 : batches_at_once(round);
  const std::uint64_t pieces = rounded_up(round.end - round.begin, at_once);
  const auto size = static_cast<std::uint64_t>(processes_->size());
  const auto rank = static_cast<std::uint64_t>(processes_->rank());
  const std::uint64_t mine = pieces > rank ? rounded_up(pieces - rank, size) : 0;
  std::atomic<std::uint64_t> finished = 0;
  const double run_before = batches_run();
  const auto piece = [&](unsigned worker, std::size_t i) {
    const std::uint64_t first = round.begin + (rank + i * size) * at_once;
    const std::uint64_t first_trial = trials_before(first);
    const std::uint64_t trials = trials_before(std::min(first + at_once, round.end)) - first_trial;
    auto& part = parts[worker];
    if (!part) part.emplace(*experiment_, state.scale);
    if (figures) {
      (*figures)[first - round.begin] =
          part->add_block_with_figures(*experiment_, first_trial, trials, options_.coverage);
    } else {
      part->add_block(*experiment_, first_trial, trials);
    }
    ++finished;
  };
  const auto tick = [&] {
    const double batches =
        divided_ ? batches_run() - run_before : static_cast<double>(finished * at_once);
    show_progress(static_cast<double>(round.begin) + batches * static_cast<double>(size));
    return size > 1 || !Interrupt::requested();
  };
  const std::uint64_t done = in_parallel(options_.threads, mine, piece, tick);
  if (divided_ && divided_->was_interrupted()) {
    parts = Parts(options_.threads);
    return round.begin;
  }
  return size > 1 ? round.end : std::min(round.end, round.begin + done * at_once);
}

// The number of batches that a thread runs in one piece. It is large enough to keep the histograms
// in the cache, and small enough that each thread gets several pieces.
std::uint64_t StudyRunner::batches_at_once(const Round& round) const {
  const auto workers = options_.threads * static_cast<std::uint64_t>(processes_->size());
  const std::uint64_t most = algo::kBlocksAtOnce * algo::block_trials(*experiment_) / batch_trials_;
  return std::clamp((round.end - round.begin) / (4 * workers), std::uint64_t{1},
                    std::max(std::uint64_t{1}, most));
}

// On rank 0, passes the batches of all processes to the adaptive rule in their order, until the
// rule ends the study. Returns the number of the batch after that, or the end of the round.
std::uint64_t StudyRunner::feed_rule(const Round& round, Figures figures, StudyWork& state) {
  gather(figures);
  if (!processes_->first()) return processes_->broadcast_number(0);
  std::uint64_t batch = round.begin;
  while (batch < round.end && !rule_ended()) {
    auto& of_batch = figures[batch++ - round.begin];
    rule_->add(of_batch);
    state.rule.push_back(std::move(of_batch));
  }
  // The factor by which 2 s must decrease until all outputs are within their tolerances. s is
  // proportional to 1 / sqrt(number of blocks).
  double ratio = 0;
  for (const auto& output : rule_->progress())
    ratio = std::max(ratio, output.worst / output.tolerance);
  expected_batches_ = std::isfinite(ratio) ? static_cast<double>(batch) * ratio * ratio : 0;
  return processes_->broadcast_number(batch);
}

// Collects the figures of all batches on rank 0. The batches belong to the processes in turn, as in
// work_share().
void StudyRunner::gather(Figures& figures) const {
  const auto size = static_cast<std::size_t>(processes_->size());
  const auto each = [&](int rank, const auto& visit) {
    for (auto i = static_cast<std::size_t>(rank); i < figures.size(); i += size) visit(figures[i]);
  };
  const std::size_t bytes = experiment_->outputs().size() * sizeof(algo::BlockFigures);
  if (!processes_->first()) {
    std::string mine;
    each(processes_->rank(), [&](const auto& batch) {
      mine.append(reinterpret_cast<const char*>(batch.data()), bytes);
    });
    return processes_->send(0, mine);
  }
  for (int from = 1; from < processes_->size(); ++from) {
    const std::string theirs = processes_->receive(from);
    const char* next = theirs.data();
    each(from, [&](auto& batch) {
      batch.resize(experiment_->outputs().size());
      std::memcpy(batch.data(), next, bytes);
      next += bytes;
    });
  }
}

// Merges the statistics of all processes in the statistics of rank 0, in a binary tree.
void StudyRunner::collect(StudyWork& state) {
  const int rank = processes_->rank(), size = processes_->size();
  for (int step = 1; step < size; step *= 2) {
    if (rank % (2 * step) != 0) {
      processes_->send(rank - step, state.statistics.serialise());
      state.statistics = algo::StudyStatistics(*experiment_, state.scale);
      break;
    }
    if (rank + step >= size) continue;
    const auto theirs =
        algo::StudyStatistics::parse(processes_->receive(rank + step), *experiment_);
    assert(theirs);  // valid: the same program wrote the bytes
    state.statistics.merge(*theirs);
  }
  state.trials = trials_before(done_);
  state.elapsed_s =
      elapsed_before_s_ + std::chrono::duration<double>(Clock::now() - begin_).count();
}

void StudyRunner::note_convergence(StudyWork& state) const {
  if (!processes_->first() || !std::has_single_bit(done_)) return;
  add_convergence(state, options_.coverage);
}

void StudyRunner::checkpoint(StudyWork& state) {
  if (!processes_->first() || Clock::now() < next_checkpoint_) return;
  if (options_.checkpoint) options_.checkpoint(state);
  next_checkpoint_ = Clock::now() + kCheckpoint;
}

// The number of trials before this batch. With a fixed number of trials, the last batch is shorter;
// with the adaptive rule, all batches have the same size.
std::uint64_t StudyRunner::trials_before(std::uint64_t batch) const {
  const std::uint64_t trials = batch * batch_trials_;
  return options_.trials && !options_.adaptive ? std::min(trials, *options_.trials) : trials;
}

void StudyRunner::show_progress(double batches) {
  if (!bar_ || expected_batches_ <= 0) return;
  const double batch_trials = static_cast<double>(batch_trials_);
  const double done_batches =
      std::min(batches, 0.999 * expected_batches_);  // the rule may need more
  bar_->show({done_batches * batch_trials, expected_batches_ * batch_trials, "trials"});
}

double StudyRunner::batches_run() const {
  return divided_ ? static_cast<double>(divided_->trials_run()) / static_cast<double>(batch_trials_)
                  : 0;
}

}  // namespace mdof::tools
