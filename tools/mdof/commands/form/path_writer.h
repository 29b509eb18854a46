// Writes the path of a fast tool servo to a file, one row for each point.
#pragma once

#include <cstddef>
#include <string>

#include "algo/form/spiral_path.h"
#include "schema/base/output/output_files.h"
#include "schema/base/result.h"

namespace mdof::tools {

enum class PathForm {
  table,  // CSV: t_s,rho_mm,theta_deg,z_um,on_part
  // G code with inverse time feed (G93): X is the radius in mm, C the angle in degrees, Z in mm.
  gcode
};
PathForm path_form(const std::string& file);  // The ending of the file name decides the form.

struct PathRates {
  double speed_rpm = 0;
  std::size_t points_per_turn = 0;
  double t_s(std::size_t index) const {
    return static_cast<double>(index) * 60 / (speed_rpm * static_cast<double>(points_per_turn));
  }
  double theta_deg(std::size_t index) const {
    return static_cast<double>(index) * 360 / static_cast<double>(points_per_turn);
  }
};

class PathWriter {
 public:
  PathWriter(std::string file, const PathRates& rates)
      : file_(std::move(file)), rates_(rates), form_(path_form(file_)), out_(Existing::replace) {}
  Status begin();
  Status add(const algo::PathPoint& point);
  Status finish();

 private:
  Status flush();
  // Appends `before` and the number x. 9 decimals are a resolution of 1 ns (x in s), 1 pm (x in mm)
  // or 1e-9 degree.
  void word(const char* before, double x, int decimals = 9);
  std::string file_;
  PathRates rates_;
  PathForm form_;
  OutputFiles out_;
  std::size_t number_ = 0;
  bool is_first_ = true;
  std::string text_;
};

}  // namespace mdof::tools
