#include "tools/mdof/commands/separate/separation_output.h"

#include <CLI/CLI.hpp>
#include <algorithm>

#include "daemon/paths.h"
#include "daemon/words/words.h"
#include "schema/run_json.h"
#include "schema/separation/separation_json.h"
#include "tools/mdof/options.h"
#include "tools/mdof/output.h"
#include "tools/mdof/terminal.h"
#include "tools/mdof/text/analyses/separation_text.h"
#include "tools/mdof/text/notice_lines.h"

namespace mdof::tools {
namespace {

// What the user can do so that the set-ups determine the complete map.
std::string remedy_of_unseen(const SeparationRecord& record) {
  const bool is_turned =
      std::any_of(record.sources.begin(), record.sources.end(), [](const SeparationSource& s) {
        return s.height_sign < 0 && !s.end_for_end && s.shift_m == 0;
      });
  return is_turned ? "Measure at the same positions in all set-ups"
                   : "Measure once more with the target turned about the moving axis, but not "
                     "shifted";
}

// Errors: the height map may not be used, or it has undetermined components. The rig would subtract
// the map without these components, as if the target were flat in them.
Status check_map(const SeparationRecord& record, const daemon::Judged& judged,
                 const OutputOptions& options) {
  if (!options.rig_toml) return {};
  if (Status passed = check_gate(judged, options.consent, "no height map for a rig is printed");
      !passed) {
    passed.error().code = ErrorCode::check;
    return passed;
  }
  if (options.despite_unseen || record.result.target.whole()) return {};
  return fail(
      ErrorCode::check,
      "these set-ups do not determine the complete height map of the target (not determined: " +
          undetermined_text(record.result.target) +
          "). The map would contain 0 for the undetermined part. " + remedy_of_unseen(record) +
          ", or give --despite-unseen");
}

Notices compared_sides(const LoadedSources& loaded) {
  std::vector<algo::SidesOfSetUp> set_ups;
  for (std::size_t k = 0; k < loaded.probes.size(); ++k)
    set_ups.push_back({loaded.record.sources[k].name, loaded.request.set_ups[k].turn.height_sign,
                       loaded.probes[k]});
  return algo::compare_sides(set_ups, loaded.request.match_m);
}

Status write_separation(const SeparationRecord& record, const Notices& notices,
                        const OutputOptions& options) {
  if (options.rig_toml) return write_out(separation_plane_toml(record));
  if (options.csv) return write_out(separation_csv(record));
  if (options.json) return write_line(with_notices(separation_json(record), notices, words::text));
  return write_out(separation_text(record, terminal_columns()));
}

// False: the set-ups contradict each other.
bool is_consistent(const Separation& result) {
  return std::none_of(result.notices.begin(), result.notices.end(),
                      [](const Notice& n) { return n.severity == Severity::invalid; });
}

// Adds the names of the files and runs to an error message, in which the algorithm only writes
// "set-up 2".
Error with_set_up_names(Error error, const SeparationRecord& record) {
  std::string names;
  for (std::size_t k = 0; k < record.sources.size(); ++k)
    names += (k > 0 ? ", " : "") + std::to_string(k + 1) + " is " + record.sources[k].name;
  error.message += " (set-up " + names + ")";
  return error;
}

}  // namespace

void add_output_options(CLI::App& command, OutputOptions& o) {
  add_all_warnings_flag(command, o.all_warnings);
  add_csv_and_json_flags(command, o.csv, o.json);
  auto* toml =
      command.add_flag("--rig-toml", o.rig_toml,
                       "Print the height of the target as a [[plane]] table for a rig file");
  toml->excludes(command.get_option("--csv"))->excludes(command.get_option("--json"));
  add_consent_flags(command, o.consent, "a map");
  command
      .add_flag("--despite-unseen", o.despite_unseen,
                "Print the height map although the set-ups do not determine the complete map")
      ->needs(toml);
}

Status separate_and_print(LoadedSources loaded, const char* method, const OutputOptions& options) {
  auto separated = algo::separate(loaded.request);
  if (!separated)
    return tl::unexpected(with_set_up_names(std::move(separated.error()), loaded.record));
  SeparationRecord& record = loaded.record;
  record.method = method;
  record.created_utc = daemon::utc_now();
  record.result = std::move(*separated);
  Notices& notices = loaded.notices;
  append(notices, compared_sides(loaded));
  append(notices, record.result.notices);
  show_notices(notices, options.all_warnings);
  const daemon::Judged judged{daemon::JudgedKind::separation, "", record.simulated,
                              daemon::doubtful_notices(notices)};
  MDOF_CHECK(check_map(record, judged, options));
  record.marks = daemon::warning_marks(judged);
  record.doubtful = !judged.doubtful.empty();
  MDOF_CHECK(write_separation(record, notices, options));
  if (is_consistent(record.result)) return {};
  return fail(ErrorCode::check,
              "the result is invalid, because the set-ups contradict each other; correct the cause "
              "and separate again");
}

}  // namespace mdof::tools
