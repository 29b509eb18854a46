#include "daemon/measure/gate/gate.h"

#include <algorithm>
#include <utility>

#include "algo/compensation/compensation.h"
#include "algo/sequence/usable_runs.h"
#include "schema/imported/series.h"
#include "schema/rig/rig_notes.h"
#include "schema/severity.h"

namespace mdof::daemon {
namespace {

constexpr std::size_t kMostMarks = 5;

// A run's notes are of its encoder's datum and of its rig; that the rig was calibrated and its
// readings corrected is no doubt.
std::vector<std::string> doubtful_notes(const Run& run) {
  std::vector<std::string> notes = run.header.notes;
  for (const std::string& good : rig_notes(run.header.provenance.rig_text)) std::erase(notes, good);
  return notes;
}

}  // namespace

std::vector<std::string> doubts_among(std::vector<std::string> sentences) {
  std::erase_if(sentences, [](const auto& s) { return severity_of(s) == Severity::information; });
  return sentences;
}

std::vector<std::string> datum_doubts(const std::vector<Run>& runs) {
  std::vector<std::string> doubts;
  for (const Run& run : runs)
    for (const std::string& note : doubtful_notes(run))
      doubts.push_back(said_of("run " + std::to_string(run.header.id), note));
  return doubts;
}

std::vector<std::string> doubts_of(const std::vector<Run>& runs) {
  std::vector<std::string> doubts = datum_doubts(runs);
  const auto warnings = algo::inherited_warnings(algo::all_of(runs));
  doubts.insert(doubts.end(), warnings.begin(), warnings.end());
  return doubts_among(std::move(doubts));
}

Result<std::vector<std::string>> doubts_of_table(store::Store& store,
                                                 const CompensationTable& table) {
  std::vector<Run> runs(table.runs.size());
  for (std::size_t i = 0; i < runs.size(); ++i) {
    MDOF_TRY(runs[i], store.run(table.runs[i]));
  }
  std::vector<std::string> doubts = doubts_of(runs);
  if (runs.size() < 2 || is_imported(runs.front().header)) return doubts;
  MDOF_TRY(std::string uneven, algo::uneven_visits_of(runs));
  if (!uneven.empty()) doubts.push_back(said_of(algo::kOverAllRuns, uneven));
  return doubts_among(std::move(doubts));
}

Result<Judged> judged_table(store::Store& store, const CompensationTable& table) {
  Judged judged{"table " + std::to_string(table.id), table.simulated, {}};
  MDOF_TRY(judged.doubts, doubts_of_table(store, table));
  return judged;
}

Status check_gate(const Judged& judged, const Consent& consent, const std::string& consequence) {
  if (judged.simulated && !consent.simulated)
    return fail(ErrorCode::conflict,
                judged.what + " is simulated: no machine was measured, so that " + consequence +
                    ". If simulated data are meant, ask with --simulated, in the call with "
                    "\"simulated\": true");
  const auto wrong = std::find_if(judged.doubts.begin(), judged.doubts.end(), [](const auto& d) {
    return severity_of(d) == Severity::invalid;
  });
  if (wrong != judged.doubts.end())
    return fail(ErrorCode::conflict, judged.what + " is invalid, so that " + consequence + ": " +
                                         std::string(words_of_sentence(*wrong)) +
                                         ". No option allows it");
  if (judged.doubts.empty() || consent.despite_warnings) return {};
  const std::size_t n = judged.doubts.size();
  return fail(ErrorCode::conflict,
              judged.what + " is doubtful (" + std::to_string(n) +
                  (n == 1 ? " warning), so that " : " warnings), so that ") + consequence + ": " +
                  judged.doubts.front() + (n > 1 ? "; and more: see each run, mdof show RUN" : "") +
                  ". If they do no harm, ask with --despite-warnings, in the call with "
                  "\"despite_warnings\": true");
}

std::vector<std::string> marks_of(const Judged& judged) {
  std::vector<std::string> marks;
  if (judged.simulated) marks.push_back("SIMULATED: " + judged.what + ": no machine was measured");
  const std::size_t n = judged.doubts.size(), shown = std::min(n, kMostMarks);
  for (std::size_t i = 0; i < shown; ++i)
    marks.push_back("DOUBTFUL: " + judged.what + ": " + judged.doubts[i]);
  if (shown < n)
    marks.push_back("DOUBTFUL: " + judged.what + ": and " + std::to_string(n - shown) +
                    " more warnings");
  for (std::string& mark : marks)  // what it quotes is no line of its own
    for (char& c : mark)
      if (static_cast<unsigned char>(c) < ' ' || c == '\x7f') c = '?';
  return marks;
}

std::vector<std::string> marks_of(const Run& run) {
  std::vector<std::string> doubts = doubtful_notes(run);
  if (run.header.state == RunState::partial) doubts.push_back("is partial");
  const auto& warnings = run.header.warnings;
  doubts.insert(doubts.end(), warnings.begin(), warnings.end());
  return marks_of(Judged{"run " + std::to_string(run.header.id), run.header.simulated,
                         doubts_among(std::move(doubts))});
}

}  // namespace mdof::daemon
