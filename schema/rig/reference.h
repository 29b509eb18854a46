// The reference point of straightness: an error e(P) of the target is the error of its material at
// the point P of the metrology frame M.
#pragma once

#include <string_view>

#include "schema/axis.h"
#include "schema/base/result.h"

namespace mdof {

enum class Reference {
  fixture,   // P = origin of M: independent of the zero of the encoder. The default
  carriage,  // P = origin of C, which moves with the target: parameters of the paper's transform
             // (Eq. 2-12)
  tool,      // P = tool_point_mm of the rig
};
const char* to_string(Reference reference);
// False: the name is not "fixture", "carriage" or "tool".
bool reference_from(std::string_view name, Reference& reference);

// Reference point of a result.
struct StatedAt {
  Reference reference = Reference::fixture;
  Vec3 point_m{};  // P in M, machine axes; undefined for the carriage
  bool operator==(const StatedAt&) const = default;
};
inline constexpr StatedAt kAtFixture{Reference::fixture, {}};
inline constexpr StatedAt kAtCarriage{Reference::carriage, {}};

struct Rig;
// Error (usage): the reference is the tool, but the rig has no tool_point_mm.
Result<StatedAt> stated_at(const Rig& rig, Reference reference);
// Default reference of a table: the tool point if the rig has one, else the fixture.
StatedAt stated_at_by_default(const Rig& rig);

}  // namespace mdof
