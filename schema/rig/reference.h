// The reference point P of straightness, in the metrology frame M. An error e(P) of the target is
// the error of the target's material at P.
#pragma once

#include <string_view>

#include "schema/axis.h"
#include "schema/base/result.h"

namespace mdof {

enum class Reference {
  fixture,   // P = origin of M; P does not depend on the zero of the encoder. Default
  carriage,  // P = origin of C, which moves with the target: parameters of the paper's transform
             // (Eq. 2-12)
  tool,      // P = tool_point_mm of the rig
};
const char* to_string(Reference reference);
// Returns false if the name is not "fixture", "carriage" or "tool".
bool reference_from(std::string_view name, Reference& reference);

// The reference point for which a result is stated.
struct StatedAt {
  Reference reference = Reference::fixture;
  Vec3 point_m{};  // P in M, components along the machine's axes; undefined for the carriage
  bool operator==(const StatedAt&) const = default;
};
inline constexpr StatedAt kAtFixture{Reference::fixture, {}};
inline constexpr StatedAt kAtCarriage{Reference::carriage, {}};

struct Rig;
// Error (usage): the reference is the tool, but the rig has no tool_point_mm.
Result<StatedAt> stated_at(const Rig& rig, Reference reference);
// Default reference of a table: the tool point if the rig has a tool point, otherwise the fixture.
StatedAt stated_at_by_default(const Rig& rig);

}  // namespace mdof
