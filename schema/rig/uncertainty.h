// Standard uncertainties that a rig declares (GUM 4.3, type B). All keys are optional. If a key is
// absent, its uncertainty is 0 here, and a result names the key as not declared. A key with the
// value 0 states that the contribution is negligible; a result does not name it.
#pragma once

#include <limits>
#include <string_view>

#include "schema/axis.h"
#include "schema/base/toml/toml_reader.h"

namespace mdof {

// Distribution of the possible values of a quantity, JCGM 101 6.4.
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
// Three independent components, along the axes of the machine.
struct DeclaredUncertainty3 {
  Vec3 u{};
  UncertaintyShape shape = UncertaintyShape::normal;
  double freedom = std::numeric_limits<double>::infinity();
  bool zero = false;  // true: all three components are declared as 0
  bool declared() const { return u[0] > 0 || u[1] > 0 || u[2] > 0; }
  bool known() const { return declared() || zero; }
  DeclaredUncertainty component(std::size_t k) const { return {u[k], shape, freedom}; }
};

struct ProbeUncertainty {
  DeclaredUncertainty calibration;  // zero of the readings, constant during a run; m
  DeclaredUncertainty sensitivity;  // relative uncertainty of the scale of the readings; no unit
  DeclaredUncertainty3 position;    // position of the probe; m
  // Tilt of the probe's direction about each of two axes perpendicular to this direction; rad.
  DeclaredUncertainty direction;
};

struct RigUncertainty {
  DeclaredUncertainty encoder;  // position at each target, independent from target to target; m
  // Angles of the whole fixture about the machine's axes; rad.
  DeclaredUncertainty3 installation_angle;
  DeclaredUncertainty3 installation_offset;  // offset of the whole fixture; m
  DeclaredUncertainty drift;                 // drift of each probe, proportional to time; m/s
};

// Reads an uncertainty. A number is the standard uncertainty of a normal distribution. An inline
// table contains also the distribution and the degrees of freedom:
//   u_calibration_um = { u = 0.05, distribution = "rectangular", dof = 8 }
//   u_calibration_um = { half_width = 0.1, distribution = "rectangular" }   limits ±0.1
// `to_si`: factor from the unit of the key to SI. `most`: largest possible u in the unit of the
// key; a larger u has a wrong unit. An absent key is not declared. Errors are recorded in the
// table.
DeclaredUncertainty read_uncertainty(TomlTable& table, std::string_view key, double to_si,
                                     double most);
// As read_uncertainty(), with three numbers, or with one number for all three components.
DeclaredUncertainty3 read_uncertainty3(TomlTable& table, std::string_view key, double to_si,
                                       double most);
// Records an error if u is not from 0 to `most`.
void check_uncertainty(TomlTable& table, std::string_view key, double u, double most);

// Largest u of lengths, angles and sensitivities of a fixture: 10 mm for a reading, 100 mm for a
// position, 0.5 rad, and 50 % of a sensitivity.
inline constexpr double kMostU_um = 1e4, kMostU_mm = 100, kMostU_mrad = 500, kMostU_ppm = 5e5;

}  // namespace mdof
