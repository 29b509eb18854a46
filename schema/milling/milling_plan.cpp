#include "schema/milling/milling_plan.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "schema/base/number/number_text.h"
#include "schema/base/toml/toml_reader.h"

namespace mdof {
namespace {

constexpr double kDeg = std::numbers::pi / 180;
constexpr double kMm = 1e-3, kUm = 1e-6, kPerMm2 = 1e6, kPerMm = 1e3, kPercent = 0.01;

// Limits of a number: greater than `above`, at most `up_to`.
struct Limits {
  double above = 0, up_to = 0;
  bool includes_lower = false;
};
constexpr double kHuge = 1e12;
constexpr double kMostYoung_GPa = 10'000;  // diamond: 1100
// A value in another unit (GPa, N/m^2) is outside: wax has about 10 N/mm^2, hard steel with chips
// of 1 um about 20,000.
constexpr Limits kCuttingForce_N_per_mm2{5, 200'000}, kRadialForce_N_per_mm2{0, 200'000, true};
constexpr Limits kEdgeForce_N_per_mm{0, 10'000, true};  // steel: 20 to 100
constexpr Limits kSpindle_rpm{0, 2'000'000};            // the fastest spindles: 500,000
constexpr Limits kPositive{0, kHuge}, kNotNegative{0, kHuge, true}, kFinite{-kHuge, kHuge};

class Reader {
 public:
  Reader(TomlTable& root, std::vector<std::pair<const MillingInput*, double>>& u)
      : root_(root), u_(u) {}

  // Returns the TOML table with this name; a missing table is reported as an error.
  TomlTable& table(const char* name) {
    name_ = name;
    table_ = root_.table(name);
    if (!table_) root_.reject(name, std::string("table [") + name + "] is missing; add this table");
    return table_ ? *table_ : root_;
  }

  double number(const char* key, const Limits& limits, std::optional<double> fallback = {}) {
    if (!table_) return 0;
    const double x = table_->number(key, fallback);
    const bool above = limits.includes_lower ? x >= limits.above : x > limits.above;
    if (!(above && x <= limits.up_to))
      table_->reject(key, "is " + text(x) + "; " +
                              (above || limits.up_to < kHuge ? range(limits) : lower(limits)));
    read_u(key);
    return x;
  }

  int count(const char* key, int least, int most, std::optional<std::int64_t> fallback = {}) {
    if (!table_) return least;
    const std::int64_t n = table_->integer(key, fallback);
    if (n < least || n > most)
      table_->reject(key, "is " + std::to_string(n) + "; it must be " + std::to_string(least) +
                              " to " + std::to_string(most));
    return static_cast<int>(std::clamp<std::int64_t>(n, least, most));
  }

  template <class E>
  E one_of(const char* key, const std::vector<E>& values, E fallback) {
    if (!table_) return fallback;
    const std::string word = table_->string(key, to_string(fallback));
    std::string known;
    for (const E value : values) {
      if (word == to_string(value)) return value;
      known += (known.empty() ? "\"" : ", \"") + std::string(to_string(value)) + "\"";
    }
    table_->reject(key, "is \"" + word + "\"; it must be one of " + known);
    return fallback;
  }

  // Reads the standard uncertainty of an input of the present table, if it is declared.
  void read_u(const std::string& key) {
    for (const MillingInput& input : milling_inputs()) {
      if (std::string(input.table) != name_ || key != input.key) continue;
      const std::string u_key = "u_" + key;
      if (!table_->has(u_key)) continue;
      const double u = table_->number(u_key);
      if (!(u >= 0 && u <= kHuge))
        table_->reject(u_key, "is " + text(u) + "; " + range(kNotNegative));
      if (u > 0) u_.emplace_back(&input, u * input.unit);
    }
  }

 private:
  static std::string text(double x) { return plain_number(x, 6); }
  static std::string lower(const Limits& limits) {
    return std::string("it must be ") + (limits.includes_lower ? "at least " : "above ") +
           text(limits.above);
  }
  // Other keys can limit a value more than `up_to`.
  static std::string range(const Limits& limits) {
    return lower(limits) + " and at most " + text(limits.up_to);
  }

  TomlTable& root_;
  std::vector<std::pair<const MillingInput*, double>>& u_;
  std::string name_;
  std::optional<TomlTable> table_;
};

void read_sections(TomlTable& tool, Reader& reader, MillingPlan& plan) {
  for (const char* factor : {"overhang_percent", "beam_diameter_percent"}) reader.read_u(factor);
  if (!tool.has("sections_mm")) {
    const double overhang = reader.number("overhang_mm", kPositive) * kMm;
    const double ratio = reader.number("equivalent_diameter", {0, 1}, 0.8);
    plan.sections = {{overhang, ratio * plan.diameter_m}};
    return;
  }
  for (const char* key : {"overhang_mm", "equivalent_diameter"})
    if (tool.has(key)) tool.reject(key, "contradicts sections_mm; give only one of the two keys");
  for (const auto& row : tool.matrix("sections_mm")) {
    if (row.size() != 2 || !(row[0] > 0 && row[0] < kHuge) || !(row[1] > 0 && row[1] < kHuge)) {
      tool.reject("sections_mm", "each section must be [length, diameter], both greater than 0");
      return;
    }
    plan.sections.push_back({row[0] * kMm, row[1] * kMm});
  }
  if (plan.sections.empty()) tool.reject("sections_mm", "must contain at least one section");
}

constexpr std::string_view kMicroEndMill =
    R"(# Huo et al., Modeling the influence of tool deflection, Micromachines 8 (2017) 188
name = "micro end mill of Huo et al."
[tool]
diameter_mm = 0.5
teeth = 2                    # not given; (-1)^z of Eq. 8 implies it
helix_deg = 30               # not given
overhang_mm = 2.0            # not given
equivalent_diameter = 0.8
youngs_modulus_GPa = 600     # not given: tungsten carbide
[runout]
radial_um = 1.0              # not given
angle_deg = 30               # not given
[cut]
mode = "up"                  # not given
spindle_rpm = 30000
feed_per_tooth_um = 15
radial_depth_mm = 0.3
axial_depth_mm = 0.05
[force]
source = "Al 7075 by carbide, dry: Chinese Journal of Mechanical Engineering 34 (2021), 10.1186/s10033-021-00536-9, Table 5, without its edge forces; the paper of Huo et al. states no force coefficients"
Kt_N_per_mm2 = 1319.41
Kr_N_per_mm2 = 788.83
[model]
deflection = "paper"
)";

struct Mode {
  bool is_up;
};
const char* to_string(Mode mode) {
  return mode.is_up ? "up" : "down";
}

}  // namespace

double MillingPlan::overhang_m() const {
  double sum = 0;
  for (const ToolSection& section : sections) sum += section.length_m;
  return sum * overhang_factor;
}

std::vector<ToolSection> MillingPlan::beam() const {
  std::vector<ToolSection> scaled = sections;
  for (ToolSection& section : scaled) {
    section.length_m *= overhang_factor;
    section.diameter_m *= beam_diameter_factor;
  }
  return scaled;
}

const char* to_string(ChipModel model) {
  return model == ChipModel::sine ? "sine" : model == ChipModel::eq8 ? "eq8" : "trochoid";
}
const char* to_string(DeflectionModel model) {
  return model == DeflectionModel::rigid   ? "rigid"
         : model == DeflectionModel::paper ? "paper"
                                           : "steady";
}

const std::vector<MillingInput>& milling_inputs() {
  using P = MillingPlan;
  static const std::vector<MillingInput> inputs = {
      {"tool", "helix_deg", &P::helix_rad, kDeg},
      {"tool", "youngs_modulus_GPa", &P::youngs_modulus_Pa, 1e9},
      {"runout", "radial_um", &P::runout_m, kUm},
      {"runout", "angle_deg", &P::runout_angle_rad, kDeg},
      {"cut", "feed_per_tooth_um", &P::feed_per_tooth_m, kUm},
      {"cut", "radial_depth_mm", &P::radial_depth_m, kMm},
      {"cut", "axial_depth_mm", &P::axial_depth_m, kMm},
      {"force", "Kt_N_per_mm2", &P::Kt, kPerMm2},
      {"force", "Kr_N_per_mm2", &P::Kr, kPerMm2},
      {"force", "Kte_N_per_mm", &P::Kte, kPerMm},
      {"force", "Kre_N_per_mm", &P::Kre, kPerMm},
      {"tool", "overhang_percent", &P::overhang_factor, kPercent},
      {"tool", "beam_diameter_percent", &P::beam_diameter_factor, kPercent},
  };
  return inputs;
}

std::string_view micro_end_mill_preset() {
  return kMicroEndMill;
}

Result<DeclaredMillingPlan> parse_milling_plan(std::string_view text, const std::string& source) {
  MDOF_TRY(TomlTable root, TomlTable::parse(text, source));
  DeclaredMillingPlan out;
  MillingPlan& plan = out.plan;
  plan.name = root.string("name", "");
  Reader read(root, out.u);

  TomlTable& tool = read.table("tool");
  plan.diameter_m = read.number("diameter_mm", {0, 1000}) * kMm;
  plan.teeth = read.count("teeth", 1, 20);
  plan.helix_rad = read.number("helix_deg", {0, 80, true}, 0.0) * kDeg;
  read_sections(tool, read, plan);
  plan.youngs_modulus_Pa = read.number("youngs_modulus_GPa", {0, kMostYoung_GPa}) * 1e9;

  if (root.has("runout")) {
    read.table("runout");
    plan.runout_m = read.number("radial_um", kNotNegative, 0.0) * kUm;
    plan.runout_angle_rad = read.number("angle_deg", {-360, 360, true}, 0.0) * kDeg;
    plan.runout_tilt = read.number("tilt_um_per_mm", kFinite, 0.0) * kUm / kMm;
  }

  TomlTable& cut = read.table("cut");
  plan.is_up = read.one_of<Mode>("mode", {{true}, {false}}, {true}).is_up;
  plan.spindle_hz = read.number("spindle_rpm", kSpindle_rpm) / 60;
  plan.feed_per_tooth_m = read.number("feed_per_tooth_um", kPositive) * kUm;
  plan.radial_depth_m = read.number("radial_depth_mm", kPositive) * kMm;
  plan.axial_depth_m = read.number("axial_depth_mm", kPositive) * kMm;
  if (plan.radial_depth_m > plan.diameter_m)
    cut.reject("radial_depth_mm",
               "exceeds tool.diameter_mm, but a cut cannot be wider than the tool");
  if (plan.axial_depth_m > plan.overhang_m())
    cut.reject("axial_depth_mm", "must not exceed the overhang of the tool");
  if (plan.feed_per_tooth_m * plan.teeth > plan.radius_m())
    cut.reject("feed_per_tooth_um",
               "must be smaller: feed_per_tooth_um times tool.teeth must not exceed the radius of "
               "the tool");
  if (plan.runout_m + std::abs(plan.runout_tilt) * plan.axial_depth_m > plan.radius_m() / 10)
    root.reject(
        "runout",
        "radial_um plus |tilt_um_per_mm| times cut.axial_depth_mm must not exceed a tenth of "
        "the radius of the tool");

  TomlTable& force = read.table("force");
  plan.force_source = force.string("source", "");
  plan.Kt = read.number("Kt_N_per_mm2", kCuttingForce_N_per_mm2) * kPerMm2;
  plan.Kr = read.number("Kr_N_per_mm2", kRadialForce_N_per_mm2) * kPerMm2;
  plan.Kte = read.number("Kte_N_per_mm", kEdgeForce_N_per_mm, 0.0) * kPerMm;
  plan.Kre = read.number("Kre_N_per_mm", kEdgeForce_N_per_mm, 0.0) * kPerMm;

  if (root.has("model")) {
    read.table("model");
    plan.chip = read.one_of(
        "chip", std::vector{ChipModel::sine, ChipModel::eq8, ChipModel::trochoid}, ChipModel::eq8);
    plan.deflection = read.one_of(
        "deflection",
        std::vector{DeflectionModel::rigid, DeflectionModel::paper, DeflectionModel::steady},
        DeflectionModel::steady);
    plan.elements = read.count("elements", 1, 100, 10);
    plan.steps_per_turn = read.count("steps_per_turn", 360, 1'000'000, 3600);
    plan.wall_grid_m = read.number("wall_grid_um", {0.001, 10, true}, 0.05) * kUm;
  }
  MDOF_CHECK(root.finish());
  return out;
}

}  // namespace mdof
