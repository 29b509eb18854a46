// The reference point P of straightness, in the metrology frame M. The error e(P) of the target is
// the error of that point of the target that is at P.
#pragma once

#include <string>
#include <string_view>

#include "schema/axis.h"
#include "schema/base/result.h"

namespace mdof {

enum class Reference {
  fixture,   // P = origin of M; P does not depend on the zero of the encoder. Default
  carriage,  // P = origin of C, which moves with the target. The errors are then the parameters of
             // Eq. 2-12 of the paper (algo/README.md)
  tool,      // P = tool_point_mm of the rig
};
const char* to_string(Reference reference);
// Returns false if the name is not "fixture", "carriage" or "tool".
bool reference_from(std::string_view name, Reference& reference);

// The reference point of the straightness errors of a result.
struct StatedAt {
  Reference reference = Reference::fixture;
  Vec3 point_m{};  // P in M, components along the machine's axes; undefined for the carriage
  bool operator==(const StatedAt&) const = default;
};
// The point as a text for readers: "fixture", "carriage", "tool 1, 2, 30 mm".
std::string reference_text(const StatedAt& at);
inline constexpr StatedAt kAtFixture{Reference::fixture, {}};
inline constexpr StatedAt kAtCarriage{Reference::carriage, {}};

struct Rig;
// Error (usage): the reference is the tool, but the rig has no tool_point_mm.
Result<StatedAt> stated_at(const Rig& rig, Reference reference);
// Default reference of a table: the tool point if the rig has a tool point, otherwise the fixture.
StatedAt default_reference(const Rig& rig);

}  // namespace mdof
