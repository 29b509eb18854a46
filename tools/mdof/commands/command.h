// The commands of mdof, one file each. add_X() declares the command and its options; when it is the
// one that was called, `chosen` becomes what it does.
#pragma once

#include <functional>

#include "schema/base/result.h"

namespace CLI {
class App;
}

namespace mdof::tools {

using Action = std::function<Status()>;

void add_solve(CLI::App& app, Action& chosen);
void add_replay(CLI::App& app, Action& chosen);
void add_runs(CLI::App& app, Action& chosen);
void add_history(CLI::App& app, Action& chosen);
void add_show(CLI::App& app, Action& chosen);
void add_analyse(CLI::App& app, Action& chosen);
void add_squareness(CLI::App& app, Action& chosen);
void add_compensation(CLI::App& app, Action& chosen);
void add_sensitivity(CLI::App& app, Action& chosen);
void add_studies(CLI::App& app, Action& chosen);
void add_study(CLI::App& app, Action& chosen);
void add_verify(CLI::App& app, Action& chosen);
void add_record(CLI::App& app, Action& chosen);
void add_stop(CLI::App& app, Action& chosen);
void add_export(CLI::App& app, Action& chosen);
void add_encoder(CLI::App& app, Action& chosen);
void add_device(CLI::App& app, Action& chosen);
void add_setup(CLI::App& app, Action& chosen);
void add_doctor(CLI::App& app, Action& chosen);
void add_status(CLI::App& app, Action& chosen);
void add_live(CLI::App& app, Action& chosen);
void add_selftest(CLI::App& app, Action& chosen);

}  // namespace mdof::tools
