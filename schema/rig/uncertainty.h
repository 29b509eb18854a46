// Standard uncertainties that a rig declares (GUM 4.3, type B). All are optional. An undeclared
// uncertainty is 0 here, and a result names it as not declared. A declared 0 is a statement: the
// contribution is known to be negligible and is not missing.
#pragma once

#include <limits>
#include <string_view>

#include "schema/axis.h"
#include "schema/base/toml/toml_reader.h"

namespace mdof {

// Distribution of an unknown value, JCGM 101 6.4.
enum class UncertaintyShape { normal, rectangular, triangular, u_shaped };
const char* to_string(UncertaintyShape shape);

struct DeclaredUncertainty {
  double u = 0;  // standard uncertainty, SI
  UncertaintyShape shape = UncertaintyShape::normal;
  double freedom = std::numeric_limits<double>::infinity();  // degrees of freedom, GUM G.4
  bool zero = false;                                         // the key is present with the value 0
  bool declared() const { return u > 0; }
  bool known() const { return declared() || zero; }
};
// Three independent components along the machine's axes.
struct DeclaredUncertainty3 {
  Vec3 u{};
  UncertaintyShape shape = UncertaintyShape::normal;
  double freedom = std::numeric_limits<double>::infinity();
  bool zero = false;  // all three are declared as 0
  bool declared() const { return u[0] > 0 || u[1] > 0 || u[2] > 0; }
  bool known() const { return declared() || zero; }
  DeclaredUncertainty component(std::size_t k) const { return {u[k], shape, freedom}; }
};

struct ProbeUncertainty {
  DeclaredUncertainty calibration;  // of the zero of its readings, constant during a run; m
  DeclaredUncertainty sensitivity;  // relative uncertainty of their scale; 1
  DeclaredUncertainty3 position;    // m
  DeclaredUncertainty direction;    // about each of two axes perpendicular to its direction; rad
};

struct RigUncertainty {
  DeclaredUncertainty encoder;               // between any two targets; m
  DeclaredUncertainty3 installation_angle;   // of the whole fixture about the machine's axes; rad
  DeclaredUncertainty3 installation_offset;  // m
  DeclaredUncertainty drift;                 // of each probe, proportional to time; m/s
};

// A number is the standard uncertainty of a normal distribution. An inline table gives more:
//   u_calibration_um = { u = 0.05, distribution = "rectangular", dof = 8 }
//   u_calibration_um = { half_width = 0.1, distribution = "rectangular" }   limits ±0.1
// `to_si`: factor from the unit of the key. Absent: not declared. Errors are recorded in the table.
DeclaredUncertainty read_uncertainty(TomlTable& table, std::string_view key, double to_si);
// The same with three numbers, or one number for all three.
DeclaredUncertainty3 read_uncertainty3(TomlTable& table, std::string_view key, double to_si);

}  // namespace mdof
