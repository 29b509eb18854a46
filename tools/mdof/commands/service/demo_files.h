// The example configuration (daemon/examples/), embedded in the program: mdof demo needs no files.
#pragma once

namespace mdof::tools {

extern const char k_mdofd_toml[], k_rig_X_toml[], k_rig_Y_toml[];

}  // namespace mdof::tools
