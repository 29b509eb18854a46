// mdof verify: checks that data have not changed since they were written: the database with the
// recordings and logs of its runs, or one recording.
#include <CLI/CLI.hpp>

#include "daemon/measure/replay/verify_sources.h"
#include "daemon/words/error_text.h"
#include "drivers/recording/recording_log.h"
#include "schema/base/json_writer.h"
#include "schema/notice/notice_json.h"
#include "tools/mdof/commands/command.h"
#include "tools/mdof/options.h"
#include "tools/mdof/output.h"
#include "tools/mdof/stored/database.h"
#include "tools/mdof/text/notice_lines.h"

namespace mdof::tools {
namespace {

struct VerifyCommand {
  std::string database, recording, head;
  bool json = false;
};

bool is_sha256(const std::string& text) {
  return text.size() == 64 && text.find_first_not_of("0123456789abcdef") == std::string::npos;
}

// Contains the changes that were found, and the files that could not be checked.
using daemon::SourceCheck;

void add(const std::vector<std::string>& more, std::vector<std::string>& to) {
  to.insert(to.end(), more.begin(), more.end());
}

// Checks the database, then the files from which its runs were made.
Status verify_database(const std::string& option, const std::string& head, SourceCheck& check,
                       store::ChainHead& now) {
  MDOF_TRY(store::Store store, open_to_read(option));
  if (const auto of_chain = store.chain_head()) now = *of_chain;
  MDOF_TRY(const auto redefined, store.verify_definitions());
  add(redefined, check.findings);
  const auto found = store.verify();
  // If a table was redefined, it may not be possible to read the data.
  if (!found && redefined.empty()) return tl::unexpected(found.error());
  if (!found) check.findings.push_back(found.error().message);
  if (!found) return {};
  add(*found, check.findings);
  MDOF_TRY(const bool has_head, head.empty() ? Result<bool>(true) : store.has_hash(head));
  if (!has_head)
    check.findings.push_back(
        "data that was stored before mdofd reported the hash " + head +
        " (--head) was removed or changed: the chain of hashes does not contain this hash");
  const auto sources = daemon::verify_sources(store);
  // If the database is damaged, its list of files may be missing; the damage was reported above.
  if (!sources) return check.findings.empty() ? Status(tl::unexpected(sources.error())) : Status();
  add(sources->findings, check.findings);
  append(check.notices, sources->notices);
  return {};
}

Status verify_recording(const std::string& file, SourceCheck& check) {
  drivers::RecordingLog log("recording", file);
  MDOF_CHECK(log.open());
  show_notices(log.notices(), true);
  SampleBlock block;
  for (;;) {
    const auto state = log.read(block, {});
    if (!state && state.error().code != ErrorCode::bad_input) return tl::unexpected(state.error());
    if (!state) check.findings.push_back(words::text(state.error()));
    if (!state || *state == drivers::ReadState::end) return {};
  }
}

void write_texts(JsonWriter& json, const char* key, const std::vector<std::string>& texts) {
  json.key(key).begin_array();
  for (const auto& text : texts) json.value(text);
  json.end_array();
}

std::string head_text(const store::ChainHead& head) {
  return "link " + std::to_string(head.link) + ", SHA-256 " + head.sha256;
}

std::string verify_json(const SourceCheck& check, const store::ChainHead& head) {
  JsonWriter json;
  json.begin_object().field("sound", check.findings.empty());
  write_texts(json, "findings", check.findings);
  write_notices(json, "notices", check.notices, words::text);
  json.key("head");
  head.link > 0 ? json.value(head.sha256) : json.null();
  json.key("link");
  head.link > 0 ? json.value(head.link) : json.null();
  json.end_object();
  return json.take();
}

Status verify(const VerifyCommand& command) {
  if (!command.head.empty() && !is_sha256(command.head))
    return fail(ErrorCode::usage, "verify: --head \"" + command.head +
                                      "\" is not a SHA-256 hash (64 digits 0-9 a-f); mdofd reports "
                                      "the hash in its journal and in server.info");
  SourceCheck check;
  store::ChainHead head;
  if (!command.recording.empty()) MDOF_CHECK(verify_recording(command.recording, check));
  if (command.recording.empty() || !command.database.empty())
    MDOF_CHECK(verify_database(command.database, command.head, check, head));
  if (command.json) MDOF_CHECK(write_line(verify_json(check, head)));
  show_notices(check.notices, true);
  for (const auto& finding : check.findings) say(finding);
  if (!check.findings.empty())
    return fail(ErrorCode::check,
                "verify: " + std::to_string(check.findings.size()) +
                    " fault(s) found; restore the items that are named above from a backup");
  if (command.json) return {};
  if (head.link > 0) say("the newest link of the chain of hashes is " + head_text(head));
  return write_line(
      "no fault found: every checksum is correct, and so is every link between stored records" +
      std::string(head.link > 0 ? "; the uncertainties in the SQL views have no checksum" : ""));
}

Action declare_verify(CLI::App& command) {
  const auto o = std::make_shared<VerifyCommand>();
  add_database_option(command, o->database);
  auto* recording =
      command
          .add_option("--recording", o->recording,
                      "Check this recording instead of the database; with --db, mdof checks both")
          ->type_name("FILE.mdofrec");
  command
      .add_option(
          "--head", o->head,
          "Hash that mdofd reported (journal, server.info); mdof checks that the data stored "
          "before this report was not removed or changed")
      ->type_name("HASH")
      ->excludes(recording);
  add_json_flag(command, o->json);
  return [o] { return verify(*o); };
}

}  // namespace

Command verify_command() {
  return {.name = "verify",
          .summary = "Check all hashes of the database, and of the recordings and logs of the runs",
          .footer =
              "Examples:\n"
              "  mdof verify\n"
              "  mdof verify --recording run-12.mdofrec",
          .declare = declare_verify};
}

}  // namespace mdof::tools
