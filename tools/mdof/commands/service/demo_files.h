// The example configuration (daemon/examples/). It is part of the program, so that mdof demo needs
// no other files.
#pragma once

namespace mdof::tools {

extern const char k_mdofd_toml[], k_rig_X_toml[], k_rig_Y_toml[];

}  // namespace mdof::tools
