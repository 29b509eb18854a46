// The chain over a grid of the commands of two linear axes. The effect of one axis on a point
// depends on its own command only, so it is calculated once for each command and not for each
// point.
#pragma once

#include <vector>

#include "algo/machine/tool_error.h"

namespace mdof::algo {

struct GridPlan {
  std::size_t first = 0, second = 1;  // directions of the two axes: X, Y, Z
  std::vector<double> first_m, second_m;
  Command others{};  // commands of the other axes
  MachineApproach approach = MachineApproach::mean;

  Command command(std::size_t i, std::size_t j) const;
};

// Error of the tool's place in the work's coordinates, actual - nominal, m.
class GridErrors {
 public:
  GridErrors(const Machine& machine, const GridPlan& plan);
  void begin_line(std::size_t j);  // line j of the second axis; call it before at()
  Eigen::Vector3d at(std::size_t i) const { return actual_.at(i) - nominal_.at(i); }

 private:
  enum class Varies { nowhere, with_first, with_second };
  // Neighbouring frames that vary with the same axis, or with none, are one displacement.
  struct Segment {
    Varies varies = Varies::nowhere;
    std::vector<Pose> poses;  // by command of that axis; one pose for Varies::nowhere
  };
  struct Chain {
    Eigen::Vector3d tool;
    std::vector<Segment> segments;  // in the order from the tool's point to the work

    // The current line: its number, the tool's point after its first segments, and their number.
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

// Standard uncertainty of the tool's place, as in error_uncertainty(). The arm of a linear axis'
// errors is linear in the other axis' command, so the variance by an axis is a polynomial of second
// order in it. The effect of a part that frames share (frames.h) on the place is linear.
class GridVariances {
 public:
  GridVariances(const Machine& machine, const GridPlan& plan);
  void begin_line(std::size_t j);                            // call it before u_at()
  Eigen::Vector3d u_at(std::size_t i, std::size_t j) const;  // m; NaN: no u is declared

 private:
  // Over a range as a coordinate from -1 to 1.
  struct Parabola {
    Eigen::Vector3d constant, linear, square;
    double rounding = 0;  // smaller values are rounding
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
      first_axis_variances_;  // by frames that move with the first axis, along the second
  Parabola line_variance_;    // by all others, along the first axis
  std::size_t shared_ = 0;    // number of parts that frames share
  std::vector<std::vector<Line>> first_axis_shared_;
  std::vector<Line> line_shared_;
};

}  // namespace mdof::algo
