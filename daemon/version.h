#pragma once

namespace mdof::daemon {

// Version of mdof; the build sets it from the version of the project. The provenance of every
// result contains the version.
extern const char* const kVersion;

}  // namespace mdof::daemon
