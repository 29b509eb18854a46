// Rigs for tests. Their text is TOML, the format of a user's rig file.
#pragma once

#include <string>

#include "schema/rig/rig.h"

namespace mdof::test {

// The default fixture of the paper for the axis X, with its three lengths in mm.
inline std::string rig_x_toml(double l_mm = 10, double h_mm = 15, double z_mm = 20) {
  const auto probe = [](const std::string& id, double x, double y, double z, const char* measures) {
    return "[[probe]]\nid = \"" + id + "\"\nposition_mm = [" + std::to_string(x) + ", " +
           std::to_string(y) + ", " + std::to_string(z) + "]\nmeasures = \"" + measures +
           "\"\nrange_um = 200\n";
  };
  return "name = \"test\"\naxis = \"X\"\n" + probe("A", l_mm, 0, 0, "+Z") +
         probe("B", 0, l_mm, 0, "+Z") + probe("C", 0, -l_mm, 0, "+Z") +
         probe("D", 0, h_mm, z_mm, "+Y") + probe("E", l_mm, h_mm, z_mm, "+Y");
}

inline Rig rig_x(double l_mm = 10, double h_mm = 15, double z_mm = 20) {
  return parse_rig(rig_x_toml(l_mm, h_mm, z_mm), "rig_X.toml").value();
}

// The default fixture. `keys` are added to the text of one probe, and `end` is appended to the
// file.
inline Rig rig_x_with(const std::string& probe, const std::string& keys,
                      const std::string& end = "") {
  std::string toml = rig_x_toml();
  if (!probe.empty())
    toml.insert(toml.find('\n', toml.find("id = \"" + probe + "\"")) + 1, keys + "\n");
  return parse_rig(toml + end, "rig_X.toml").value();
}

// The default fixture with 0, 1 or 2 redundant probes (F, G): 5, 6 or 7 probes.
inline Rig rig_x_redundant(std::size_t probes) {
  std::string toml = rig_x_toml();
  if (probes > 5)
    toml += "[[probe]]\nid = \"F\"\nposition_mm = [-10, 5, 0]\nmeasures = \"+Z\"\nrange_um = 200\n";
  if (probes > 6)
    toml +=
        "[[probe]]\nid = \"G\"\nposition_mm = [-10, 15, 10]\nmeasures = \"+Y\"\nrange_um = 200\n";
  return parse_rig(toml, "rig.toml").value();
}

// Seven probes, each at a different position and in a different direction.
inline Rig rig_oblique() {
  return parse_rig(R"(
name = "oblique"
axis = "X"
probe = [
  {id = "P1", position_mm = [12, 3, 0], measures = "+Z", range_um = 200},
  {id = "P2", position_mm = [-4, 11, 0], measures = "-Z", range_um = 200},
  {id = "P3", position_mm = [2, -9, 0], measures = "+Z", range_um = 200},
  {id = "P4", position_mm = [1, 15, 18], measures = "+Y", range_um = 200},
  {id = "P5", position_mm = [13, 15, 25], measures = "-Y", range_um = 200},
  {id = "P6", position_mm = [5, 5, 0], direction = [0.1, 0.0, 1.0], range_um = 200},
  {id = "P7", position_mm = [7, 15, 30], direction = [0.05, 1.0, 0.1], range_um = 200},
]
[[plane]]
id = "top"
normal = "+Z"
[[plane]]
id = "side"
normal = "+Y"
)",
                   "oblique.toml")
      .value();
}

}  // namespace mdof::test
