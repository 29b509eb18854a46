#include "daemon/measure/gate/gate.h"

#include <algorithm>
#include <optional>
#include <utility>

#include "algo/compensation/compensation.h"
#include "algo/sequence/uneven_visits.h"
#include "algo/sequence/usable_runs.h"
#include "daemon/measure/gate/added_table.h"
#include "daemon/words/words.h"
#include "schema/base/append_new.h"
#include "schema/imported/series.h"
#include "schema/rig/report_facts.h"

namespace mdof::daemon {
namespace {

constexpr std::size_t kMostMarks = 5;

using words::Language;

std::string name_of(const Judged& judged, Language language) {
  const bool german = language == Language::german;
  switch (judged.kind) {
    case JudgedKind::run:
      return (german ? "Messung " : "run ") + judged.name;
    case JudgedKind::table:
      return (german ? "Tabelle " : "table ") + judged.name;
    case JudgedKind::squareness:
      return (german ? "Rechtwinkligkeit " : "squareness ") + judged.name;
    case JudgedKind::separation:
      return german ? "diese Trennung" : "this separation";
    case JudgedKind::file:
      break;
  }
  return judged.name;
}

// The first invalid notice, or nullptr.
const Notice* invalid_notice(const Notices& notices) {
  const auto found = std::find_if(notices.begin(), notices.end(),
                                  [](const Notice& n) { return n.severity == Severity::invalid; });
  return found == notices.end() ? nullptr : &*found;
}

// The run that this run continues, whose points it contains; nullopt: it continues no run.
std::optional<std::int64_t> continued_run(const RunHeader& run) {
  const bool goes_on = std::any_of(run.notices.begin(), run.notices.end(), [](const Notice& n) {
    return n.code == NoticeCode::run_goes_on;
  });
  return goes_on ? run.supersedes : std::nullopt;
}

}  // namespace

Notices without_information(Notices notices) {
  std::erase_if(notices, [](const Notice& n) { return n.severity == Severity::information; });
  return notices;
}

Notices doubtful_notices(Notices notices) {
  for (Notice& each : notices)
    if (each.code == NoticeCode::datum_missing || each.code == NoticeCode::position_lost ||
        each.code == NoticeCode::drift_in_reversal || each.code == NoticeCode::change_in_reversal)
      each.severity = Severity::doubtful;
  return without_information(std::move(notices));
}

Notices doubtful_notices(const std::vector<Run>& runs) {
  return doubtful_notices(algo::inherited_notices(algo::all_of(runs)));
}

Result<store::TablesOfRun> applied_tables(store::Store& store, std::int64_t id) {
  store::TablesOfRun applied;
  for (std::optional<std::int64_t> part = id; part;) {
    MDOF_TRY(const RunHeader run, store.run_header(*part));
    const std::string& kind = run.provenance.recording_kind;
    if (kind != "recording" && kind != "csv") break;
    const std::optional<std::int64_t> continued = continued_run(run);
    MDOF_TRY(const store::TablesOfRun active, store.active_during(run, continued));
    applied.changed |= active.changed;
    for (const std::int64_t table : active.tables) {
      MDOF_TRY(const bool volumetric, store.is_volumetric(table));
      if (volumetric) {
        MDOF_TRY(const VolumetricTable grid, store.volumetric(table));
        const auto axis = static_cast<std::size_t>(run.axis);
        if (grid.command_m[axis].size() < 2) continue;  // the same correction at all targets
      }
      append_new(applied.tables, {table});
    }
    part = continued;
  }
  return applied;
}

Result<Notices> source_run_notices(store::Store& store, const std::vector<std::int64_t>& runs,
                                   std::optional<std::int64_t> added_to) {
  Notices found;
  for (const std::int64_t run : runs) {
    MDOF_TRY(const auto by, store.superseded_by(run));
    if (by)
      found.push_back(notice(NoticeCode::made_from_superseded, "", {{"run", run}, {"by", *by}}));
    MDOF_TRY(store::TablesOfRun applied, applied_tables(store, run));
    std::vector<std::int64_t>& tables = applied.tables;
    if (added_to) std::erase(tables, *added_to);
    if (tables.empty()) continue;
    MDOF_TRY(const RunHeader header, store.run_header(run));
    for (const std::int64_t table : tables)
      found.push_back(
          header.start_known
              ? notice(NoticeCode::measured_with_table, "", {{"run", run}, {"table", table}})
              : notice(NoticeCode::undated_with_table, "",
                       {{"run", run}, {"table", table}, {"date", header.started_utc}}));
  }
  return found;
}

Result<Notices> differences_of_runs(const std::vector<Run>& runs) {
  MDOF_TRY(Notices found, algo::uneven_visit_notices(runs));
  const auto content = [](const Run& run) {
    return result_content(run.header.provenance.rig_text);
  };
  const bool differ = std::any_of(runs.begin() + 1, runs.end(), [&](const Run& run) {
    return content(run) != content(runs.front());
  });
  if (differ) found.push_back(notice(NoticeCode::rigs_differ));
  return found;
}

Result<Notices> doubtful_notices(store::Store& store, const CompensationTable& table) {
  std::vector<Run> runs(table.runs.size());
  for (std::size_t i = 0; i < runs.size(); ++i) {
    MDOF_TRY(runs[i], store.run(table.runs[i]));
  }
  Notices found = doubtful_notices(runs);
  MDOF_TRY(Notices of_runs, source_run_notices(store, table.runs, table.added_to));
  append(found, std::move(of_runs));
  MDOF_TRY(Notices added, added_notices(store, table));
  append(found, std::move(added));
  if (runs.size() < 2 || is_imported(runs.front().header)) return found;
  MDOF_TRY(Notices differences, differences_of_runs(runs));
  append(found, std::move(differences));
  return without_information(std::move(found));
}

Result<Judged> judged_table(store::Store& store, const CompensationTable& table) {
  Judged judged{JudgedKind::table, std::to_string(table.id), table.simulated, {}};
  MDOF_TRY(judged.doubtful, doubtful_notices(store, table));
  return judged;
}

bool is_invalid(const RunHeader& run) {
  return invalid_notice(run.notices) != nullptr;
}

const char* only_approach(const Run& run) {
  bool forward = false, reverse = false, unknown = false;
  for (const MeasuredPoint& p : run.points) {
    if (!p.errors.valid && !is_imported(run.header)) continue;
    forward = forward || p.point.direction > 0;
    reverse = reverse || p.point.direction < 0;
    unknown = unknown || p.point.direction == 0;
  }
  if (unknown || forward == reverse) return "";
  return forward ? "forward" : "reverse";
}

std::string doubt_reason(const Run& run) {
  const std::string of = "run " + std::to_string(run.header.id);
  if (const Notice* wrong = invalid_notice(run.header.notices))
    return of + " is invalid: " + words::text(*wrong);
  Notices doubts = run.header.notices;
  if (!is_imported(run.header))  // runs of earlier versions may lack these notices
    append_new(doubts, algo::uneven_visits(run.points));
  doubts = without_information(std::move(doubts));
  if (doubts.empty()) return "";
  std::string reason = of + " is doubtful";
  for (std::size_t i = 0; i < std::min(doubts.size(), kMostMarks); ++i)
    reason += std::string(i == 0 ? ": " : "; ") + words::text(doubts[i]) + " (notice " +
              to_string(doubts[i].code) + ")";
  if (doubts.size() > kMostMarks)
    reason += "; and " + std::to_string(doubts.size() - kMostMarks) + " more";
  return reason;
}

std::string undecidable_reason(store::Store& store, const Run& run) {
  const std::string of = "run " + std::to_string(run.header.id);
  if (is_invalid(run.header)) return doubt_reason(run);
  const auto by = store.superseded_by(run.header.id);
  if (!by) return by.error().message;
  if (*by) return "run " + std::to_string(**by) + " supersedes " + of;
  if (run.header.state != RunState::complete)
    return of + (run.header.state == RunState::failed ? " " : " is ") + to_string(run.header.state);
  const std::string approach = only_approach(run);
  if (!approach.empty() && !is_imported(run.header))
    return of + " has the " + approach + " approach only, so the reversal is unknown";
  return doubt_reason(run);
}

Status check_gate(const Judged& judged, const Consent& consent, const std::string& consequence) {
  const std::string name = name_of(judged, Language::english);
  if (judged.simulated && !consent.simulated)
    return fail(ErrorCode::conflict,
                name + " is simulated (no machine was measured), so " + consequence,
                Remedy::allow_simulated);
  if (const Notice* wrong = invalid_notice(judged.doubtful))
    return fail(ErrorCode::conflict, name + " is invalid, so " + consequence + ": " +
                                         words::text(*wrong) + ". No option overrides this check");
  if (judged.doubtful.empty() || consent.despite_warnings) return {};
  const std::size_t n = judged.doubtful.size();
  return fail(ErrorCode::conflict,
              name + " is doubtful (" + std::to_string(n) +
                  (n == 1 ? " notice), so " : " notices), so ") + consequence + ": " +
                  words::text(judged.doubtful.front()) +
                  (n > 1 ? "; and " + std::to_string(n - 1) + " more" : ""),
              Remedy::allow_doubtful);
}

std::vector<std::string> warning_marks(const Judged& judged, Language language) {
  const bool german = language == Language::german;
  const std::string of = name_of(judged, language) + ": ";
  const std::string doubtful = (german ? "ZWEIFELHAFT: " : "DOUBTFUL: ") + of;
  std::vector<std::string> marks;
  if (judged.simulated)
    marks.push_back((german ? "SIMULIERT: " : "SIMULATED: ") + of +
                    (german ? "keine Maschine wurde gemessen" : "no machine was measured"));
  const std::size_t n = judged.doubtful.size(), shown = std::min(n, kMostMarks);
  for (std::size_t i = 0; i < shown; ++i)
    marks.push_back(doubtful + words::line(judged.doubtful[i], language));
  if (const std::size_t more = n - shown; more > 0)
    marks.push_back(doubtful + (german ? "und " : "and ") + std::to_string(more) +
                    (german ? (more == 1 ? " weiterer Hinweis" : " weitere Hinweise")
                            : (more == 1 ? " more notice" : " more notices")));
  for (std::string& mark : marks)  // quoted text must not contain a line break
    for (char& c : mark)
      if (static_cast<unsigned char>(c) < ' ' || c == '\x7f') c = '?';
  return marks;
}

std::vector<std::string> warning_marks(const Run& run, Language language) {
  Notices notices;
  if (run.header.state == RunState::partial) notices.push_back(notice(NoticeCode::run_partial));
  append(notices, run.header.notices);
  return warning_marks(Judged{JudgedKind::run, std::to_string(run.header.id), run.header.simulated,
                              doubtful_notices(std::move(notices))},
                       language);
}

}  // namespace mdof::daemon
