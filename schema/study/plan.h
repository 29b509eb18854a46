// The plan of a sensitivity study, made by the user: the rig, the quantities that vary, their
// distributions, and the outputs. algo/sensitivity/PLAN.md describes the format.
#pragma once

#include <cstddef>
#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "schema/base/result.h"
#include "schema/point.h"
#include "schema/rig/rig.h"
#include "schema/study/quantity.h"

namespace mdof {

// A distribution of JCGM 101 §6.4 with its parameters, in the unit of the quantity.
struct Distribution {
  enum class Kind {
    constant,
    rectangular,
    triangular,
    trapezoidal,
    u_shaped,
    normal,
    t,
    empirical
  };
  Kind kind = Kind::constant;
  double low = 0, high = 0;    // rectangular, triangular, trapezoidal, u_shaped
  double mode = 0;             // triangular
  double beta = 0;             // trapezoidal: width of the top / width of the base, 0 ... 1
  double centre = 0;           // constant, normal, t
  double spread = 0;           // normal: standard deviation; t: scale
  double dof = 0;              // t
  std::vector<double> sample;  // empirical: ascending
};
const char* to_string(Distribution::Kind kind);

struct PlannedQuantity {
  std::string name;  // name as in the plan; a star in it means all probes
  Distribution distribution;
  std::string where;  // "plan.toml:12: quantity[2].name", for messages
};

// Joint distribution of several quantities, by a Gaussian copula. Stars in the names are already
// expanded.
struct PlannedCorrelation {
  std::vector<std::string> quantities;
  std::vector<double> matrix;  // row-major, symmetric, ones on the diagonal
  std::string where;
};

// An output that is calculated in each trial.
enum class OutputKind {
  error,         // estimated value minus true value of one of the five errors: "EYX_um"
  straightness,  // error of the straightness (least squares) of a series: "EYX_straightness_um"
  straightness_ends,  // the same for the end-point line: "EYX_straightness_end_point_um"
  squareness,         // error of "EC0Y_urad", from one series of each axis
  worst,              // largest |error| at the points of a whole run: "EYX_worst_um"
};
struct PlannedOutput {
  std::string key;
  OutputKind kind = OutputKind::error;
  std::size_t error = 0;  // index in error_names() of the rig's axis
};

struct PlannedAdaptive {
  int digits = 2;                            // significant digits; used if no tolerance is given
  std::map<std::string, double> tolerances;  // numerical tolerance for each output key
};

struct PlannedIndices {
  // Number of base trials. A base trial needs two evaluations, plus one evaluation for each cause.
  std::uint64_t trials = 65536;
  // True: a star means one cause for each probe; false: it means one cause for all probes.
  bool each_probe = false;
};

struct PlannedAllocation {
  std::string output;
  double limit = 0;  // in the unit of the output
  double probability = 0.95;
  std::vector<std::string> tolerances;  // names of quantities, as in PlannedQuantity
  std::uint64_t trials = 20000;
  std::string where;
};

// A whole run. The samples of a rig with random deviations are simulated and evaluated like those
// of a real run.
struct PlannedRun {
  std::vector<double> targets_mm;
  double dwell_s = 0.4;
  double rate_hz = 500;
  double speed_mm_s = 20;
};

enum class Forward { rigid, small_angle };  // model of the probe readings, see algo/model

// Limit for `bins`. With 200 bins and five outputs, the statistics of each thread need 33 MB. A
// plan has at most ten outputs.
inline constexpr std::size_t kMostStudyBins = 200;

struct StudyPlan {
  std::string name;
  std::string source;  // file name, for messages
  std::string text;    // the TOML text, for provenance
  Rig rig;
  std::optional<Rig> rig_y;    // for squareness only: the rig of the second axis
  std::optional<Rig> compare;  // the rig of [compare]
  Model model = Model::exact;
  Forward forward = Forward::rigid;
  bool zero_at_start = true;
  std::uint64_t trials = 100000, seed = 1;
  double coverage = 0.95;
  std::vector<PlannedOutput> outputs;
  bool whole_run = false;                   // output_of = "run"
  std::vector<PlannedQuantity> quantities;  // the quantities of [truth] come first
  std::vector<PlannedCorrelation> correlations;
  std::string binned_key;  // "": no bins
  std::size_t bins = 1;
  std::size_t series_positions = 11;
  // Period of the true errors along the travel; 0: the period is the whole travel.
  double series_period_mm = 0;
  double fixture_per_K = 0, target_per_K = 0;  // expansion coefficients, 1/K
  double flatness_length_mm = 30;              // longest wavelength of a random height
  std::optional<PlannedAdaptive> adaptive;
  std::optional<PlannedIndices> indices;
  std::vector<PlannedAllocation> allocations;
  PlannedRun run;
};

// Reads a plan and the rigs and samples that it names; their paths start from the folder of the
// plan. Errors name file, line and key; the error for an unknown word names the most similar known
// word. Mathematical errors (a rig that cannot determine an error, an invalid correlation matrix)
// are found later, by make_plan_experiment().
Result<StudyPlan> parse_study_plan(std::string_view toml_text, const std::string& source_name);

}  // namespace mdof
