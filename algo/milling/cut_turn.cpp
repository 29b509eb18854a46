#include "algo/milling/cut_turn.h"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <limits>
#include <string>
#include <utility>

#include "algo/linear_algebra/least_squares.h"
#include "algo/milling/beam.h"

namespace mdof::algo {
namespace {

using Eigen::Index;
using Eigen::VectorXd;

constexpr double kEquilibrium_m = 1e-13;
constexpr int kMostNewtonSteps = 15, kMostPseudoSteps = 600;
constexpr double kNoPseudoTime = std::numeric_limits<double>::infinity();  // plain Newton's method
// The edge force reaches its full value at this thickness of the chip. If the edge force had its
// full value at once, there would be no equilibrium at angles where the deflection moves the tooth
// out of the workpiece.
constexpr double kWholeEdge_m = 20e-9;
// Turns; the second turn starts with the deflection at the end of the first.
constexpr int kPasses = 2;

// The part of one tooth in one element, at all angles of a turn.
struct Tooth {
  CuttingEdge edge;
  // Angle φ of the tooth, without a jump by 2π while the tooth is in the workpiece; the first
  // angles may be below 0.
  std::vector<double> angle;
  std::vector<Chip> rigid;  // one for each angle of the turn
};

// Share of a step in which the tooth is in the workpiece, and the derivative of this share by the y
// component of the deflection.
struct Engagement {
  double share = 0, by_y = 0;
};

class Turn {
 public:
  explicit Turn(const MillingPlan& plan)
      : plan_(plan),
        steps_((plan.steps_per_turn + plan.teeth - 1) / plan.teeth * plan.teeth),
        step_rad_(kWholeTurn_rad / steps_),
        element_m_(plan.axial_depth_m / plan.elements) {
    for (int m = 0; m < plan.elements; ++m) height_m_.push_back((m + 0.5) * element_m_);
    C_ = beam_compliance(plan.beam(), plan.youngs_modulus_Pa, height_m_, height_m_);
    for (int j = 0; j < plan.teeth; ++j)
      for (int m = 0; m < plan.elements; ++m) teeth_.push_back(tooth(j, m));
    u_.assign(steps(), VectorXd::Zero(2 * plan.elements));
  }

  Result<CutTurn> solve() {
    for (int pass = 0; pass < kPasses; ++pass)
      for (std::size_t phase = 0; phase < steps() / teeth(); ++phase)
        MDOF_CHECK(equilibrium(phase));
    return result();
  }

 private:
  std::size_t steps() const { return static_cast<std::size_t>(steps_); }
  std::size_t teeth() const { return static_cast<std::size_t>(plan_.teeth); }
  Index elements() const { return plan_.elements; }
  double turned(std::size_t n) const { return step_rad_ * static_cast<double>(n); }
  Tooth& tooth_at(std::size_t j, Index m) {
    return teeth_[j * static_cast<std::size_t>(elements()) + static_cast<std::size_t>(m)];
  }

  Tooth tooth(int j, int m) const {
    Tooth tooth{CuttingEdge(plan_, j, height_m_[static_cast<std::size_t>(m)]), {}, {}};
    for (std::size_t n = 0; n < steps(); ++n) {
      double angle = tooth.edge.angle(turned(n));
      if (plan_.is_up && angle > 1.5 * kHalfTurn_rad) angle -= kWholeTurn_rad;
      tooth.angle.push_back(angle);
      tooth.rigid.push_back(tooth.edge.rigid_chip(angle));
    }
    return tooth;
  }

  // The window is the range of angles in which the tooth is in the workpiece. Its limits are
  // calculated for the deflection at this angle. If a limit is within a step, only a part of the
  // step counts. With complete steps only, there may be no equilibrium of force and deflection.
  Engagement engagement(const Tooth& t, std::size_t n, const Deflection& u) const {
    const double free = t.edge.free_side_angle(u), wall = t.edge.wall_side_angle();
    const double low = t.angle[n] - step_rad_ / 2, high = low + step_rad_;
    const double from = std::max(low, plan_.is_up ? wall : free);
    const double to = std::min(high, plan_.is_up ? free : wall);
    if (!(to > from)) return {};
    const bool at_edge =
        // In a slot the free edge is at 0 or π and does not depend on the deflection.
        free > low && free < high && free > 0 && free < kHalfTurn_rad;
    const double slope = at_edge ? 1 / (plan_.radius_m() * std::sin(free) * step_rad_) : 0;
    return {(to - from) / step_rad_, plan_.is_up ? slope : -slope};
  }

  // Returns the index of angle i of a phase. The angles of a phase are one tooth pitch apart and
  // are solved together, because each tooth cuts the surface that the tooth before produced.
  std::size_t instant(std::size_t phase, std::size_t i) const {
    return phase + i * (steps() / teeth());
  }
  std::size_t earlier(std::size_t i, int k) const {
    const auto z = static_cast<int>(teeth());
    return static_cast<std::size_t>(((static_cast<int>(i) - k) % z + z) % z);
  }

  // Forces at all angles of a phase, and the derivatives of these forces.
  struct Load {
    VectorXd F;
    Eigen::MatrixXd dF;
    double power_W = 0;
  };
  Index row(std::size_t i, Index m, Index component) const {
    return (static_cast<Index>(i) * 2 + component) * elements() + m;
  }

  Load load(std::size_t phase, const VectorXd& U, bool with_derivatives) {
    const Index n = static_cast<Index>(teeth()) * 2 * elements();
    Load load{VectorXd::Zero(n), {}, 0};
    if (with_derivatives) load.dF = Eigen::MatrixXd::Zero(n, n);
    for (std::size_t i = 0; i < teeth(); ++i)
      for (std::size_t j = 0; j < teeth(); ++j)
        for (Index m = 0; m < elements(); ++m) add_tooth(phase, i, tooth_at(j, m), m, U, load);
    return load;
  }

  void add_tooth(std::size_t phase, std::size_t i, const Tooth& t, Index m, const VectorXd& U,
                 Load& load) const {
    const std::size_t n = instant(phase, i);
    const Deflection u{U[row(i, m, 0)], U[row(i, m, 1)]};
    const Engagement engaged = engagement(t, n, u);
    if (engaged.share == 0) return;
    const Chip& rigid = t.rigid[n];
    const std::size_t e = earlier(i, rigid.earlier);
    const double angle = t.angle[n];
    const Chip chip = t.edge.chip(angle, rigid, u, {U[row(e, m, 0)], U[row(e, m, 1)]});
    if (!(chip.thickness > 0)) return;
    const double s = std::sin(angle), c = std::cos(angle), dz = element_m_ * engaged.share;
    const bool whole = chip.thickness >= kWholeEdge_m;
    const double edge = whole ? 1 : chip.thickness / kWholeEdge_m;
    const double ft = plan_.Kt * chip.thickness + plan_.Kte * edge;
    const double fr = plan_.Kr * chip.thickness + plan_.Kre * edge;
    load.F[row(i, m, 0)] += dz * (ft * c + fr * s);
    load.F[row(i, m, 1)] += dz * (ft * s - fr * c);
    if (load.dF.size() == 0) return;
    const double by_h = whole ? 0 : 1 / kWholeEdge_m;
    const double dt = plan_.Kt + plan_.Kte * by_h, dr = plan_.Kr + plan_.Kre * by_h;
    const double dx = dz * (dt * c + dr * s), dy = dz * (dt * s - dr * c);
    const auto add = [&](Index by, double slope) {
      load.dF(row(i, m, 0), by) += dx * slope;
      load.dF(row(i, m, 1), by) += dy * slope;
    };
    load.dF(row(i, m, 0), row(i, m, 1)) += element_m_ * engaged.by_y * (ft * c + fr * s);
    load.dF(row(i, m, 1), row(i, m, 1)) += element_m_ * engaged.by_y * (ft * s - fr * c);
    add(row(i, m, 0), chip.by_x);
    add(row(i, m, 1), chip.by_y);
    add(row(e, m, 0), chip.by_earlier_x);
    add(row(e, m, 1), chip.by_earlier_y);
  }

  // Returns the deflection due to these forces: the compliances C times the forces of each angle
  // and component.
  template <class M>
  M bent(const M& forces) const {
    M out(forces.rows(), forces.cols());
    for (Index block = 0; block < forces.rows(); block += elements())
      out.middleRows(block, elements()) = C_ * forces.middleRows(block, elements());
    return out;
  }

  // Solves U = C F(U) (deflections U, compliances C, forces F) by Newton's method, which converges
  // also if the iteration U ← C F(U) does not. Near the limit of the window the force changes
  // rapidly with the deflection, and Newton's method may fail. Then implicit time steps of dU/dt =
  // C F(U) - U lead to a stable equilibrium. The time step increases when the residual decreases
  // (pseudo-transient continuation, Kelley and Keyes 1998).
  Status equilibrium(std::size_t phase) {
    if (plan_.deflection == DeflectionModel::rigid) return {};
    VectorXd before(static_cast<Index>(teeth()) * 2 * elements());
    // Starts with the deflection at the angle before, so that a tooth in the workpiece stays in the
    // workpiece.
    for (std::size_t i = 0; i < teeth(); ++i)
      before.segment(row(i, 0, 0), 2 * elements()) =
          u_[(instant(phase, i) + steps() - 1) % steps()];
    for (const double first_step : {kNoPseudoTime, 1.0, 0.1, 0.01}) {
      VectorXd U = before;
      if (!settle(phase, first_step, U)) continue;
      for (std::size_t i = 0; i < teeth(); ++i)
        u_[instant(phase, i)] = U.segment(row(i, 0, 0), 2 * elements());
      return {};
    }
    return fail(
        ErrorCode::check,
        "the cutting force and the tool deflection have no stable equilibrium when the tool has "
        "turned by " +
            std::to_string(turned(phase) * 360 / kWholeTurn_rad) +
            " degrees; the tool is too weak for this cut: reduce overhang_mm or the depths of cut");
  }

  bool settle(std::size_t phase, double first_step, VectorXd& U) {
    double residual_before = 0, pseudo_time = first_step;
    const int most = std::isinf(first_step) ? kMostNewtonSteps : kMostPseudoSteps;
    for (int step = 0; step < most; ++step) {
      turn_iterations_ = std::max(turn_iterations_, step + 1);
      const Load now = load(phase, U, true);
      const VectorXd residual = U - bent(now.F);
      const double size = residual.cwiseAbs().maxCoeff();
      Eigen::MatrixXd J = -bent(now.dF);
      J.diagonal().array() += 1;
      // The determinant is negative if the cutting force increases faster with the deflection than
      // the restoring force of the tool. Such an equilibrium is unstable, but Newton's method finds
      // it, too.
      if (size < kEquilibrium_m) return Eigen::PartialPivLU<Eigen::MatrixXd>(J).determinant() > 0;
      if (step > 0) pseudo_time *= std::clamp(residual_before / size, 0.3, 1.5);
      residual_before = size;
      J.diagonal().array() += 1 / pseudo_time;
      U -= LeastSquares(J).solve(residual);
    }
    return false;
  }

  // Sets the angles at which the chip of tooth 0 begins and ends. If a limit of the window is
  // within a step, a part of the step counts. If the chip begins or ends inside the window, the
  // angle is interpolated between two steps.
  void set_window(CutTurn& turn) const {
    const Tooth& t = teeth_.front();
    turn.entry_rad = turn.exit_rad = std::numeric_limits<double>::quiet_NaN();  // no cut
    for (std::size_t n = 0; n < steps(); ++n) {
      const double h = thickness(t, 0, n), free = t.edge.free_side_angle(deflection(n, 0));
      if (!(h > 0) || engagement(t, n, deflection(n, 0)).share == 0) continue;
      const double wall = t.edge.wall_side_angle(), half = step_rad_ / 2;
      const auto reach = [&](std::size_t beside) {
        const double other = thickness(t, 0, beside);
        return other > 0 ? half : step_rad_ * h / (h - other);
      };
      const double low = t.angle[n] - reach((n + steps() - 1) % steps());
      const double high = t.angle[n] + reach((n + 1) % steps());
      turn.entry_rad = std::fmin(turn.entry_rad, std::max(low, plan_.is_up ? wall : free));
      turn.exit_rad = std::fmax(turn.exit_rad, std::min(high, plan_.is_up ? free : wall));
    }
  }
  Deflection deflection(std::size_t n, Index m) const { return {u_[n][m], u_[n][elements() + m]}; }
  double thickness(const Tooth& t, Index m, std::size_t n) const {
    const std::size_t before =
        (n + steps() -
         static_cast<std::size_t>(t.rigid[n].earlier) * (steps() / teeth()) % steps()) %
        steps();
    return t.edge
        .chip(t.angle[n], t.rigid[n], {u_[n][m], u_[n][elements() + m]},
              {u_[before][m], u_[before][elements() + m]})
        .thickness;
  }

  CutTurn result() {
    CutTurn turn;
    turn.height_m = height_m_;
    turn.iterations = turn_iterations_;
    turn.fx_N.resize(steps_, elements());
    turn.fy_N.resize(steps_, elements());
    turn.power_W.assign(steps(), 0);
    for (std::size_t n = 0; n < steps(); ++n) turn.turned_rad.push_back(turned(n));
    for (std::size_t phase = 0; phase < steps() / teeth(); ++phase) {
      VectorXd U(static_cast<Index>(teeth()) * 2 * elements());
      for (std::size_t i = 0; i < teeth(); ++i)
        U.segment(row(i, 0, 0), 2 * elements()) = u_[instant(phase, i)];
      const Load now = load(phase, U, false);
      for (std::size_t i = 0; i < teeth(); ++i) {
        const auto n = static_cast<Index>(instant(phase, i));
        turn.fx_N.row(n) = now.F.segment(row(i, 0, 0), elements()).transpose();
        turn.fy_N.row(n) = now.F.segment(row(i, 0, 1), elements()).transpose();
      }
    }
    for (std::size_t j = 0; j < teeth(); ++j)
      for (Index m = 0; m < elements(); ++m) add_power(tooth_at(j, m), m, turn);
    set_window(turn);
    return turn;
  }

  // Adds the power: tangential force times speed of the tooth. For the trochoid model the speed
  // contains the feed.
  void add_power(const Tooth& t, Index m, CutTurn& turn) const {
    for (std::size_t n = 0; n < steps(); ++n) {
      const double engaged = engagement(t, n, deflection(n, m)).share;
      const double h = thickness(t, m, n);
      if (!(engaged > 0 && h > 0)) continue;
      double radius = plan_.radius_m();
      if (plan_.chip == ChipModel::trochoid)
        radius += plan_.feed_per_tooth_m * plan_.teeth / kWholeTurn_rad * std::cos(t.angle[n]);
      turn.power_W[n] += (plan_.Kt * h + plan_.Kte * std::min(1.0, h / kWholeEdge_m)) * element_m_ *
                         engaged * kWholeTurn_rad * plan_.spindle_hz * radius;
    }
  }

  const MillingPlan& plan_;
  int steps_;
  double step_rad_, element_m_;
  std::vector<double> height_m_;
  Eigen::MatrixXd C_;
  std::vector<Tooth> teeth_;  // all elements of tooth 0, then all elements of tooth 1, ...
  int turn_iterations_ = 1;
  std::vector<VectorXd> u_;  // one for each angle: x of all elements, then y
};

}  // namespace

Eigen::MatrixXd CutTurn::force_N() const {
  Eigen::MatrixXd sum(fx_N.rows(), 2);
  sum.col(0) = fx_N.rowwise().sum();
  sum.col(1) = fy_N.rowwise().sum();
  return sum;
}

Result<CutTurn> cut_turn(const MillingPlan& plan) {
  return Turn(plan).solve();
}

Eigen::MatrixXd deflection_m(const MillingPlan& plan, const CutTurn& turn, double height_m) {
  const Eigen::MatrixXd C =
      beam_compliance(plan.beam(), plan.youngs_modulus_Pa, {height_m}, turn.height_m);
  Eigen::MatrixXd out(turn.fx_N.rows(), 2);
  out.col(0) = turn.fx_N * C.transpose();
  out.col(1) = turn.fy_N * C.transpose();
  return out;
}

}  // namespace mdof::algo
