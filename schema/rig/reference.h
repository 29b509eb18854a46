// The point at which straightness is stated: an error e(P) of the target is that of its
// material which is at the point P of the metrology frame M.
#pragma once

#include <string_view>

#include "schema/axis.h"
#include "schema/base/result.h"

namespace mdof {

enum class Reference {
  fixture,   // P = origin of M: does not depend on where the encoder is zero. The default
  carriage,  // P = origin of C, which travels with the target: parameters of the paper's transform
             // (Eq. 2-12)
  tool,      // P = tool_point_mm of the rig
};
const char* to_string(Reference reference);
// False: it is none of "fixture", "carriage", "tool".
bool reference_from(std::string_view name, Reference& reference);

// What a result is stated at.
struct StatedAt {
  Reference reference = Reference::fixture;
  Vec3 point_m{};  // P in M, machine axes; of no meaning for the carriage
  bool operator==(const StatedAt&) const = default;
};
inline constexpr StatedAt kAtFixture{Reference::fixture, {}};
inline constexpr StatedAt kAtCarriage{Reference::carriage, {}};

struct Rig;
// Error (usage): the tool is asked for and the rig has no tool_point_mm.
Result<StatedAt> stated_at(const Rig& rig, Reference reference);
// Where a table is to hold: at the rig's tool point where it has one, else at the fixture.
StatedAt stated_at_by_default(const Rig& rig);

}  // namespace mdof
