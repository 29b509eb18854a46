// mdof verify: is the database, or a recording, what was once written?
#include <CLI/CLI.hpp>

#include "drivers/recording/recording_log.h"
#include "schema/json_writer.h"
#include "tools/mdof/command.h"
#include "tools/mdof/database.h"
#include "tools/mdof/options.h"
#include "tools/mdof/output.h"

namespace mdof::tools {
namespace {

struct VerifyCommand {
  std::string database, recording;
  bool json = false;
};

// What was found wrong; a file that cannot be judged is an error.
using Findings = std::vector<std::string>;

Result<Findings> verify_database(const std::string& option) {
  MDOF_TRY(store::Store store, open_to_read(option));
  return store.verify();
}

Result<Findings> verify_recording(const std::string& file) {
  drivers::RecordingLog log("recording", file);
  MDOF_CHECK(log.open());
  for (const auto& warning : log.warnings()) warn(warning);
  SampleBlock block;
  for (;;) {
    const auto state = log.read(block, {});
    if (!state && state.error().code == ErrorCode::bad_input)
      return Findings{state.error().message};
    if (!state) return tl::unexpected(state.error());
    if (*state == drivers::ReadState::end) return Findings{};
  }
}

std::string verify_json(const Findings& findings) {
  JsonWriter json;
  json.begin_object().field("sound", findings.empty()).key("findings").begin_array();
  for (const auto& finding : findings) json.value(finding);
  json.end_array().end_object();
  return json.take();
}

Status verify(const VerifyCommand& command) {
  Findings findings;
  if (!command.recording.empty()) {
    MDOF_TRY(findings, verify_recording(command.recording));
  }
  if (command.recording.empty() || !command.database.empty()) {
    MDOF_TRY(const Findings more, verify_database(command.database));
    findings.insert(findings.end(), more.begin(), more.end());
  }
  if (command.json) MDOF_CHECK(write_line(verify_json(findings)));
  if (!findings.empty()) {
    for (const auto& finding : findings) say(finding);
    return fail(ErrorCode::check, "verify: " + std::to_string(findings.size()) +
                                      " finding(s); restore the file from a copy");
  }
  return command.json ? Status() : write_line("sound: every checksum and reference holds");
}

}  // namespace

void add_verify(CLI::App& app, Action& chosen) {
  const auto o = std::make_shared<VerifyCommand>();
  auto* command = app.add_subcommand("verify", "Check every hash and reference of the database");
  add_database_option(*command, o->database);
  command
      ->add_option("--recording", o->recording, "Check this recording instead (or, with --db, too)")
      ->type_name("FILE.mdofrec");
  add_json_flag(*command, o->json);
  command->footer(
      "Examples:\n"
      "  mdof verify\n"
      "  mdof verify --recording run-12.mdofrec");
  command->callback([o, &chosen] { chosen = [o] { return verify(*o); }; });
}

}  // namespace mdof::tools
