// Errors and uncertainties of the chain over a grid of commands of two linear axes. The
// displacement by one axis depends only on the command of this axis. Therefore the displacement is
// calculated once for each command, and not once for each point of the grid.
#pragma once

#include <vector>

#include "algo/machine/tool_error.h"

namespace mdof::algo {

struct GridPlan {
  std::size_t first = 0, second = 1;  // the two axes: 0 X, 1 Y, 2 Z
  std::vector<double> first_m, second_m;
  Command others{};  // commands of the other axes
  MachineApproach approach = MachineApproach::mean;

  Command command(std::size_t i, std::size_t j) const;
};

// Error of the tool's place in the work's coordinates, actual - nominal, m.
class GridErrors {
 public:
  GridErrors(const Machine& machine, const GridPlan& plan);
  void begin_line(std::size_t j);  // selects the points whose second command is second_m[j]; call
                                   // it before at()
  Eigen::Vector3d at(std::size_t i) const { return actual_.at(i) - nominal_.at(i); }

 private:
  enum class Varies { nowhere, with_first, with_second };
  // Neighbouring frames whose displacements depend on the same axis, or on no axis, combined into
  // one displacement.
  struct Segment {
    Varies varies = Varies::nowhere;
    std::vector<Pose> poses;  // for each command of the axis; one pose for Varies::nowhere
  };
  struct Chain {
    Eigen::Vector3d tool;
    std::vector<Segment> segments;  // from the tool's point to the work

    // For the current line j. The first `in_line` segments do not depend on the first axis; `begin`
    // is the tool's point after these segments.
    std::size_t line = 0, in_line = 0;
    Eigen::Vector3d begin;

    void add(const Segment& next);
    void begin_line(std::size_t j);
    Eigen::Vector3d through(const Segment& s, std::size_t i, const Eigen::Vector3d& point) const {
      return s.poses[s.varies == Varies::with_first    ? i
                     : s.varies == Varies::with_second ? line
                                                       : 0] *
             point;
    }
    Eigen::Vector3d at(std::size_t i) const {
      Eigen::Vector3d point = begin;
      for (std::size_t s = in_line; s < segments.size(); ++s)
        point = through(segments[s], i, point);
      return point;
    }
  };
  void add_frame(const MachineFrame& frame, const GridPlan& plan);

  Chain actual_, nominal_;
};

// Standard uncertainty of the tool's place, as in error_uncertainty(). The lever arm of the errors
// of one linear axis is linear in the command of the other axis. Therefore the variance due to the
// errors of one axis is a polynomial of second order in the command of the other axis. The effect
// of a part that several frames have in common (frames.h) is linear in the command of the other
// axis.
class GridVariances {
 public:
  GridVariances(const Machine& machine, const GridPlan& plan);
  void begin_line(std::size_t j);  // selects second_m[j]; call it before u_at()
  Eigen::Vector3d u_at(std::size_t i, std::size_t j) const;  // m; NaN: no u is declared

 private:
  // Polynomials of a coordinate that is -1 at the start of the range of an axis and 1 at its end.
  struct Parabola {
    Eigen::Vector3d constant, linear, square;
    double rounding = 0;  // a smaller variance is only rounding
    Eigen::Vector3d at(double part) const { return constant + part * (linear + part * square); }
  };
  struct Line {
    Eigen::Vector3d constant, linear;
    Eigen::Vector3d at(double part) const { return constant + part * linear; }
  };
  std::vector<FrameValues> values(const Command& command, bool of_first) const;
  Eigen::Vector3d variance(const Command& command, bool of_first) const;
  std::vector<Vector6> shared(const Command& command, bool of_first) const;
  std::vector<Line> lines(Command command, std::size_t along, const std::vector<double>& range,
                          bool of_first) const;
  Parabola parabola(Command command, std::size_t along, const std::vector<double>& range,
                    bool of_first) const;

  const Machine& machine_;
  const GridPlan& plan_;
  std::vector<double> first_part_, second_part_;
  std::vector<Parabola>
      first_axis_variances_;  // for each command of the first axis: variance due to the frames that
                              // move with the first axis, as a function of the second command
  Parabola line_variance_;  // variance due to all other frames, as a function of the first command
  std::size_t shared_ = 0;  // number of parts that several frames have in common
  std::vector<std::vector<Line>> first_axis_shared_;
  std::vector<Line> line_shared_;
};

}  // namespace mdof::algo
