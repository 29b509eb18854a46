#include "daemon/version.h"

namespace mdof::daemon {

const char* const kVersion = "mdof " MDOF_VERSION;

}  // namespace mdof::daemon
