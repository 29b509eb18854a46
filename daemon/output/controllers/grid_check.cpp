#include <algorithm>
#include <cmath>

#include "algo/compensation/volumetric/volumetric.h"
#include "daemon/output/controllers/check.h"

namespace mdof::controllers {
namespace {

constexpr double kRoundingOfGrid_m = 1e-12;
constexpr std::string_view kCommands = "XYZ";

// Largest errors of one axis: without the correction, with the correction, and with deliberate
// mistakes in the correction.
struct Residuals {
  double before = 0, with = 0, wrong_sign = 0;
  std::optional<double> exchanged;  // X and Y exchanged; nullopt: impossible
  double exchange = 0;              // largest change of the correction if X and Y are exchanged
};

// Errors that remain because of the table itself; no file can correct them.
struct LeftByTable {
  double by_reversal = 0, between_nodes = 0;
  std::string approach;  // as CheckedError::approach
};

// `left_m`: the largest part of a correction that the file format cannot represent.
CheckedError judged_by(const std::string& name, bool angle, const Residuals& r,
                       const Format& format, const ExportOptions& options, double left_m,
                       const LeftByTable& table) {
  CheckedError e;
  e.error = name;
  e.angle = angle;
  e.by_reversal = table.by_reversal;
  e.between_nodes = table.between_nodes;
  e.approach = table.approach;
  e.one_way = options.one_approach && !e.approach.empty() && e.by_reversal > 0;
  const double by_reversal = e.one_way ? 0 : e.by_reversal;
  e.before = r.before + by_reversal;  // an upper limit of the error in the worse approach
  e.residual = r.with + e.between_nodes + by_reversal;
  const double step = format.quantum_m + kRoundingOfGrid_m;
  e.bound = algo::ResidualLimits{options.residual_m, options.residual_share}.of(e.before, step);
  e.nothing = e.before <= step;
  e.cancels = r.with <= step + left_m && e.residual <= e.bound;
  e.controls.push_back({"wrong sign", r.wrong_sign, r.wrong_sign > e.bound, r.before <= e.bound});
  if (r.exchanged)
    e.controls.push_back(
        {"X and Y exchanged", *r.exchanged, *r.exchanged > e.bound, r.exchange <= 2 * e.bound});
  return e;
}

// The test points: all nodes, and the centres of all cells.
std::vector<Vec3> places_of(const VolumetricTable& table) {
  std::vector<Vec3> places;
  for (std::size_t node = 0; node < table.nodes(); ++node) {
    const Vec3 at = table.command_at(node);
    places.push_back(at);
    Vec3 middle = at;
    for (std::size_t k = 0; k < 3; ++k) {
      const auto& all = table.command_m[k];
      const auto next = std::upper_bound(all.begin(), all.end(), at[k]);
      if (next != all.end()) middle[k] = (at[k] + *next) / 2;
    }
    places.push_back(middle);
  }
  return places;
}

Residuals residuals_of(const VolumetricTable& table, const VolumetricTable& applied,
                       std::size_t k) {
  Residuals r;
  if (k < 2) r.exchanged = 0;
  for (const Vec3& at : places_of(table)) {
    const double wanted = algo::volumetric_at(table, at).correction_m[k];
    const Vec3 added = algo::volumetric_at(applied, at).correction_m;
    r.before = std::max(r.before, std::abs(wanted));
    r.with = std::max(r.with, std::abs(added[k] - wanted));
    r.wrong_sign = std::max(r.wrong_sign, std::abs(-added[k] - wanted));
    if (!r.exchanged) continue;
    r.exchanged = std::max(*r.exchanged, std::abs(added[1 - k] - wanted));
    r.exchange = std::max(r.exchange, std::abs(added[1 - k] - added[k]));
  }
  return r;
}

// The error angle that remains if the controller moves X to x + k y: motion of the tool along X, in
// m, for a command of 1 m along Y. This motion follows from the bodies in the chain; the angle
// between the axes is 90 deg + EC0Y.
double angle_after_shear(const SquareAxes& axes, double k) {
  const auto moved = [&](char axis, double command) {
    const ChainAxis* of = axes.machine.find(axis);
    const double body = of->against_command ? -command : command;
    return of->carries_work ? -body : body;  // the tool relative to the work
  };
  const double y = moved('Y', 1), x = moved('X', k);
  return x - y * std::tan(axes.EC0Y_rad);
}

}  // namespace

Result<Check> check_export(const Format& format, const VolumetricTable& table,
                           const Export& exported, const ExportOptions& options) {
  MDOF_TRY(const VolumetricTable applied, format.volume.read(exported.files));
  Check check;
  check.most_residual_m = options.residual_m;
  check.share = options.residual_share;
  for (std::size_t k = 0; k < 3; ++k)
    if (table.machine.find(kCommands[k]))
      check.errors.push_back(judged_by(std::string(1, kCommands[k]), false,
                                       residuals_of(table, applied, k), format, options,
                                       exported.left_m,
                                       {table.reversal_m[k], table.interpolation_m[k],
                                        table.approach == "mean" ? "" : table.approach}));
  return check;
}

Result<Check> check_export(const Format& format, const SquareAxes& axes, const Export& exported,
                           const ExportOptions& options) {
  MDOF_TRY(const double k, format.square.read(exported.files));
  Check check;
  check.most_residual_m = options.residual_m;
  check.share = options.residual_share;
  const Residuals r{std::abs(angle_after_shear(axes, 0)), std::abs(angle_after_shear(axes, k)),
                    std::abs(angle_after_shear(axes, -k)), std::nullopt, 0};
  check.errors.push_back(judged_by("EC0Y", true, r, format, options, 0, {}));
  return check;
}

}  // namespace mdof::controllers
