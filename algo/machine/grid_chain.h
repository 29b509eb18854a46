// The chain over a grid of the commands of two linear axes. What one axis does to a point depends
// on its own command alone, so that it is found once a command and not once a point.
#pragma once

#include <vector>

#include "algo/machine/tool_error.h"

namespace mdof::algo {

struct GridPlan {
  std::size_t first = 0, second = 1;  // directions of the two axes: X, Y, Z
  std::vector<double> first_m, second_m;
  Command others{};  // where the other axes stand
  MachineApproach approach = MachineApproach::mean;

  Command command(std::size_t i, std::size_t j) const;
};

// Error of the tool's place in the work's coordinates, actual - nominal, m.
class GridErrors {
 public:
  GridErrors(const Machine& machine, const GridPlan& plan);
  void begin_line(std::size_t j);  // of the second axis, before at() of its points
  Eigen::Vector3d at(std::size_t i) const { return actual_.at(i) - nominal_.at(i); }

 private:
  enum class Varies { nowhere, with_first, with_second };
  // Frames beside one another that vary with the same axis, or not at all, are one displacement.
  struct Segment {
    Varies varies = Varies::nowhere;
    std::vector<Pose> poses;  // by command of that axis; one of what does not vary
  };
  struct Chain {
    Eigen::Vector3d tool;
    std::vector<Segment> segments;  // as they take the tool's point to the work

    // Of a line: its number, where the first segments take the tool's point, and how many these
    // are.
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

// Standard uncertainty of that place, as of error_uncertainty(). The arm of a linear axis' errors
// is linear in the other axis' command, so that the variance which an axis adds is a polynomial of
// second order in it; what a part that frames share (frames.h) does to the place is linear.
class GridVariances {
 public:
  GridVariances(const Machine& machine, const GridPlan& plan);
  void begin_line(std::size_t j);                            // before u_at() of its points
  Eigen::Vector3d u_at(std::size_t i, std::size_t j) const;  // m; NaN: none declared

 private:
  // Of the part of a range from -1 to 1.
  struct Parabola {
    Eigen::Vector3d constant, linear, square;
    double rounding = 0;  // what is below it is rounding
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
  std::vector<Parabola> of_first_;  // of the frames that go with the first axis, along the second
  Parabola of_line_;                // of all others, along the first axis
  std::size_t shared_ = 0;          // how many parts frames share
  std::vector<std::vector<Line>> shared_of_first_;
  std::vector<Line> shared_of_line_;
};

}  // namespace mdof::algo
