#include "tools/mdof/checks/self_checks.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <random>

#include "algo/model/rigid.h"
#include "daemon/measure/pipeline.h"
#include "daemon/store/result_hash.h"
#include "daemon/store/store.h"
#include "daemon/words/error_text.h"
#include "schema/units.h"

namespace mdof::tools {
namespace {

// The default fixture of the checks.
constexpr const char* kRig = R"(
name = "default fixture"
axis = "X"
probe = [
  {id = "A", position_mm = [10, 0, 0], measures = "+Z", range_um = 400},
  {id = "B", position_mm = [0, 10, 0], measures = "+Z", range_um = 400},
  {id = "C", position_mm = [0, -10, 0], measures = "+Z", range_um = 400},
  {id = "D", position_mm = [0, 15, 20], measures = "+Y", range_um = 400},
  {id = "E", position_mm = [10, 15, 20], measures = "+Y", range_um = 400},
]
)";

constexpr int kTrials = 10000;
constexpr double kExact = 1e-9, kAngle_urad = 1.01, kStraightness_um = 0.11;

// Uniformly distributed random numbers, which are the same with every standard library.
class Random {
 public:
  double between(double low, double high) {
    return low + (high - low) * static_cast<double>(engine_() >> 11) * 0x1p-53;
  }

 private:
  std::mt19937_64 engine_{2};
};

Errors5 random_errors(Random& random) {
  Errors5 e{};
  for (const int k : {kDy, kDz}) e[static_cast<std::size_t>(k)] = random.between(-50e-6, 50e-6);
  for (const int k : {kEx, kEy, kEz}) e[static_cast<std::size_t>(k)] = random.between(-1e-3, 1e-3);
  return e;
}

// Readings of the rig's probes for these errors, calculated with the output equations of the model.
std::vector<double> readings(const algo::Solver& solver, double travel_m, const Errors5& errors) {
  std::vector<double> out(solver.fixture().probes.size());
  if (const auto& fixture = solver.small_angle()) {
    const auto exact = algo::exact_outputs(*fixture, travel_m, errors);
    for (std::size_t k = 0; k < exact.size(); ++k) out[fixture->probe[k]] = exact[k];
    return out;
  }
  const Eigen::VectorXd rigid = algo::rigid_readings(solver.fixture(), travel_m, errors);
  std::copy(rigid.begin(), rigid.end(), out.begin());
  return out;
}

struct Worst {
  double straightness_um = 0, angle_urad = 0;
  void add(const Errors5& found, const Errors5& truth) {
    for (std::size_t k = 0; k < found.size(); ++k) {
      double& worst = k <= kDz ? straightness_um : angle_urad;
      worst = std::max(worst, std::abs(to_key_unit(found[k] - truth[k])));
    }
  }
};

Result<Worst> there_and_back(const Rig& rig, Model model) {
  MDOF_TRY(const algo::Solver solver, algo::Solver::create(rig, model));
  Random random;
  Worst worst;
  for (int i = 0; i < kTrials; ++i) {
    const Errors5 truth = random_errors(random);
    const double travel_m = random.between(0, 60e-3);
    const AxisErrors found = solver.solve(travel_m, readings(solver, travel_m, truth), {});
    if (!found.valid) return fail(ErrorCode::check, found.reason);
    worst.add(found.local, truth);
  }
  return worst;
}

void check_model(const Rig& rig, Model model, std::vector<SelfCheck>& checks) {
  const bool simplified = model == Model::simplified;
  const auto worst = there_and_back(rig, model);
  const std::string name = std::string("model ") + to_string(model) + " round trip";
  const std::string problem = worst ? "" : words::text(worst.error());
  const Worst w = worst.value_or(Worst{});
  checks.push_back({name + ", straightness", w.straightness_um,
                    simplified ? kStraightness_um : kExact, "um", problem});
  checks.push_back(
      {name + ", angles", w.angle_urad, simplified ? kAngle_urad : kExact, "urad", problem});
}

// ---- a synthetic log: forward and back over five targets, twice ----

constexpr double kTargets_mm[] = {0, 7.5, 15, 22.5, 30};
constexpr int kTargets = 5, kRepeats = 2;
constexpr double kOverrun_mm = 1, kStep_s = 1e-3, kSpeed_mm_s = 20, kDwell_s = 0.4;
constexpr Errors5 kConstant{3e-6, -2e-6, 10e-6, -20e-6, 30e-6};

class SyntheticLog {
 public:
  explicit SyntheticLog(const algo::Solver& solver) : solver_(solver) {
    block_.channels.push_back({kEncoderChannel, Unit::metre});
    for (const auto& probe : solver.fixture().probes)
      block_.channels.push_back({probe.id, Unit::metre});
    block_.value.resize(block_.channels.size());
  }

  SampleBlock make() {
    for (int r = 0; r < kRepeats; ++r) {
      for (int i = 0; i < kTargets; ++i) stop_at(kTargets_mm[i]);
      move_to(kTargets_mm[kTargets - 1] + kOverrun_mm);
      for (int i = kTargets - 1; i >= 0; --i) stop_at(kTargets_mm[i]);
      move_to(-kOverrun_mm);
    }
    return std::move(block_);
  }

 private:
  void stop_at(double target_mm) {
    move_to(target_mm);
    for (int i = 0; i < kDwell_s / kStep_s; ++i) add(target_mm);
  }
  void move_to(double target_mm) {
    const double step = std::copysign(kSpeed_mm_s * kStep_s, target_mm - at_mm_);
    while (std::abs(target_mm - at_mm_) > std::abs(step)) add(at_mm_ + step);
    at_mm_ = target_mm;
  }
  void add(double position_mm) {
    at_mm_ = position_mm;
    block_.time_ns.push_back(static_cast<std::int64_t>(block_.time_ns.size()) *
                             static_cast<std::int64_t>(kStep_s * 1e9));
    block_.value[0].push_back(from_mm(position_mm));
    const auto values = readings(solver_, from_mm(position_mm), kConstant);
    for (std::size_t k = 0; k < values.size(); ++k) block_.value[k + 1].push_back(values[k]);
  }

  const algo::Solver& solver_;
  SampleBlock block_;
  double at_mm_ = -kOverrun_mm;
};

Result<Run> measure_synthetic_log(const Rig& rig) {
  MDOF_TRY(daemon::Pipeline pipeline, daemon::Pipeline::create(rig, {}));
  SampleBlock block = SyntheticLog(pipeline.solver()).make();
  MDOF_CHECK(pipeline.push(block));
  MDOF_TRY(Run run, pipeline.finish());
  run.header.simulated = true;
  run.header.note = "selftest";
  return run;
}

// Converts the errors kConstant, whose reference point is the origin of the carriage, to the origin
// of the fixture, to first order.
Errors5 constant_at_fixture(double travel_m) {
  Errors5 e = kConstant;
  e[kDy] -= travel_m * e[kEz];
  e[kDz] += travel_m * e[kEy];
  return e;
}

void check_detection(const Result<Run>& run, std::vector<SelfCheck>& checks) {
  const std::string problem = run ? "" : words::text(run.error());
  Worst worst;
  double missed = 2 * kTargets * kRepeats;
  if (run) {
    missed = std::abs(missed - static_cast<double>(run->points.size()));
    for (const auto& p : run->points) {
      worst.add(p.errors.local, constant_at_fixture(p.point.position_m));
      missed += !p.errors.valid;
    }
  }
  checks.push_back({"missing, extra or invalid points of a synthetic log", missed, 0, "", problem});
  checks.push_back({"synthetic log, straightness", worst.straightness_um, 1e-6, "um", problem});
  checks.push_back({"synthetic log, angles", worst.angle_urad, 1e-6, "urad", problem});
}

// ---- a store in a temporary folder ----

class TemporaryFolder {
 public:
  TemporaryFolder() {
    std::error_code ec;
    std::string name = (std::filesystem::temp_directory_path(ec) / "mdof-selftest-XXXXXX").string();
    if (!ec && ::mkdtemp(name.data())) path_ = name;
  }
  ~TemporaryFolder() {
    std::error_code ec;
    if (!path_.empty()) std::filesystem::remove_all(path_, ec);
  }
  TemporaryFolder(const TemporaryFolder&) = delete;
  TemporaryFolder& operator=(const TemporaryFolder&) = delete;
  const std::filesystem::path& path() const { return path_; }

 private:
  std::filesystem::path path_;
};

// Writes the run, closes the database, reads and verifies it. Returns the number of differences and
// faults.
Result<double> store_and_read_back(const Run& run) {
  const TemporaryFolder folder;
  if (folder.path().empty())
    return io_error(
        "a temporary folder cannot be created; set TMPDIR to a folder in which you can write");
  const auto file = folder.path() / "mdof.db";
  std::int64_t id = 0;
  {
    MDOF_TRY(store::Store store, store::Store::open(file, store::Access::read_write));
    MDOF_TRY(id, store.add_run(run));
  }
  MDOF_TRY(store::Store store, store::Store::open(file, store::Access::read_only));
  MDOF_TRY(const Run back, store.run(id));
  MDOF_TRY(const auto findings, store.verify());
  const bool same = store::result_sha256(back) == store::result_sha256(run);
  return static_cast<double>(findings.size()) + (same ? 0 : 1);
}

void check_store(const Result<Run>& run, std::vector<SelfCheck>& checks) {
  const auto wrong = run ? store_and_read_back(*run) : tl::unexpected(run.error());
  checks.push_back({"store, faults found when a run is read back", wrong.value_or(1), 0, "",
                    wrong ? "" : words::text(wrong.error())});
}

}  // namespace

std::vector<SelfCheck> run_self_checks() {
  std::vector<SelfCheck> checks;
  const auto rig = parse_rig(kRig, "default fixture");
  if (!rig) return {{"default fixture", 1, 0, "", words::text(rig.error())}};
  for (const Model model : {Model::simplified, Model::exact, Model::rigid})
    check_model(*rig, model, checks);
  const auto run = measure_synthetic_log(*rig);
  check_detection(run, checks);
  check_store(run, checks);
  return checks;
}

}  // namespace mdof::tools
