// The machine that `mdof machine budget` offers as a preset.
#include "schema/machine/machine.h"

namespace mdof {
namespace {

constexpr std::string_view kCoPlanar = R"toml(name = "co-planar micro machine"
simulated = true
# Wang, Ye and Gunawan, Design and accuracy analysis of a micromachine tool with a co-planar driving
# mechanism (2021). The paper has 14 joints of six part errors each (Table 1) and three screws
# (Table 2: D, C, B). Not in the paper, and chosen here:
# - which joint is mounted on which: the tool is carried by joints 1 to 4, the work by 5 to 14;
# - all places in mm;
# - which of the joints 7 and 8 is X and which is Z (the matrix of joint 7 is lost);
# - that the tilt error of 0.05 degrees is a standard uncertainty.
# Joints 3, 7, 8 and 11 are the axes Y, X, Z and B.
[machine]
chain = "w-B-Z-X-b-Y-t"
travel = { X = "-", Z = "-" }
[[axis]]
id = "B"
centre_mm = [0, -40, 0]
[[axis]]
id = "Z"
holds_at_mm = [0, -60, 0]
point = "moving"
[[axis]]
id = "X"
holds_at_mm = [0, -60, 0]
point = "moving"
[[axis]]
id = "Y"
holds_at_mm = [0, 0, 150]
point = "moving"
[[frame]]
id = "joint-14"
after = "w"
holds_at_mm = [0, -10, 0]
[[frame]]
id = "joint-13"
after = "joint-14"
holds_at_mm = [0, -20, 0]
[[frame]]
id = "joint-12"
after = "joint-13"
holds_at_mm = [0, -30, 0]
[[frame]]
id = "joint-10"     # of the screw B, across its travel
after = "B"
with = "X"
along = "Z"
ratio = 0.48428
holds_at_mm = [-60, -60, 0]
[[frame]]
id = "joint-9"      # and back
after = "joint-10"
with = "X"
along = "Z"
ratio = -0.48428
holds_at_mm = [-90, -60, 0]
[[frame]]
id = "joint-6"      # of the screw C
after = "X"
with = "Z"
along = "X"
ratio = -0.48428
holds_at_mm = [0, -60, -60]
[[frame]]
id = "joint-5"
after = "joint-6"
with = "Z"
along = "X"
ratio = 0.48428
holds_at_mm = [0, -60, -90]
[[frame]]
id = "joint-1"
after = "b"
holds_at_mm = [0, -80, 150]
[[frame]]
id = "joint-2"      # of the screw D
after = "joint-1"
with = "Y"
along = "X"
ratio = -2.06492
holds_at_mm = [40, 0, 150]
[[frame]]
id = "joint-4"
after = "Y"
with = "Y"
along = "X"
ratio = 2.06492
holds_at_mm = [0, 0, 120]

# One screw is one cause: +-0.5 um, rectangular. It moves its axis by the cosine (D: the tangent) of
# the tilt of 25.84 degrees. Its error across the travel is in two joints with opposite signs and
# cancels; that of the screw B (joint 10) does not.
[[source]]
name = "screw B"
u = 0.28867513459481287
unit = "um"
distribution = "rectangular"
acts_on = [{ error = "EXX", factor = 0.9000147034 },
           { error = "EZ(joint-10)", factor = 0.4358595343 }]
[[source]]
name = "screw C"
u = 0.28867513459481287
unit = "um"
distribution = "rectangular"
acts_on = [{ error = "EZZ", factor = 0.9000147034 },
           { error = "EX(joint-5)", factor = 0.4358595343 },
           { error = "EX(joint-6)", factor = -0.4358595343 }]
[[source]]
name = "screw D"
u = 0.28867513459481287
unit = "um"
distribution = "rectangular"
acts_on = [{ error = "EYY", factor = 0.4842804597 },
           { error = "EX(joint-2)", factor = -1 },
           { error = "EX(joint-4)", factor = 1 }]

# Section 3.4: an error of the tilt acts on the travel, by -tan(tilt) and 1/(sin(tilt) cos(tilt)).
[[source]]
name = "tilt of X"
u = 0.05
unit = "deg"
acts_on = [{ error = "EXX", factor_per_mm = -8.452288526, of = "X" }]
[[source]]
name = "tilt of Z"
u = 0.05
unit = "deg"
acts_on = [{ error = "EZZ", factor_per_mm = -8.452288526, of = "Z" }]
[[source]]
name = "tilt of Y"
u = 0.05
unit = "deg"
acts_on = [{ error = "EYY", factor_per_mm = 44.49192665, of = "Y" }]
)toml";

}  // namespace

std::string_view co_planar_machine() {
  return kCoPlanar;
}

}  // namespace mdof
