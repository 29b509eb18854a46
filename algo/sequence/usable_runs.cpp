#include "algo/sequence/usable_runs.h"

#include <algorithm>
#include <map>

#include "schema/imported/series.h"

namespace mdof::algo {
namespace {

std::string name_of(const Run& run) {
  return "run " + std::to_string(run.header.id);
}

// Such a run has the state "failed".
bool is_renumbered(const Run& run) {
  const Notices& all = run.header.notices;
  return std::any_of(all.begin(), all.end(), [](const Notice& each) {
    return each.code == NoticeCode::superseded_by_renumbering;
  });
}

Status check_state(const Run& run, bool take_partial, const std::string& what) {
  const RunState state = run.header.state;
  if (state == RunState::complete || (take_partial && state == RunState::partial)) return {};
  if (is_renumbered(run))
    return bad_input(name_of(run) +
                         " was replaced by a later run, because the targets were numbered again; "
                         "give the later run",
                     Remedy::list_runs);
  const std::string is =
      name_of(run) + (state == RunState::failed ? " " : " is ") + to_string(state);
  if (state == RunState::partial)
    return bad_input(is + ", but mdof needs complete runs for " + what +
                         "; the notices of the run state what is missing",
                     Remedy::take_partial_runs);
  return bad_input(is + ", but mdof needs complete runs for " + what,
                   state == RunState::aborted ? Remedy::resume_or_replay : Remedy::none);
}

bool continues_from(const Run& run, const Run& other) {
  return run.header.supersedes && *run.header.supersedes == other.header.id;
}

// Returns whether both points are means of the same samples. The hashes of the logs are not
// compared, because a compressed log has a different hash.
bool same_reading(const MeasuredPoint& a, const MeasuredPoint& b) {
  return a.point.begin_ns == b.point.begin_ns && a.point.end_ns == b.point.end_ns &&
         a.point.position_m == b.point.position_m && a.point.probe_m == b.point.probe_m &&
         !a.point.probe_m.empty();
}

bool share_a_reading(const Run& a, const Run& b) {
  std::multimap<std::int64_t, const MeasuredPoint*> by_time;
  for (const MeasuredPoint& p : b.points) by_time.emplace(p.point.begin_ns, &p);
  return std::any_of(a.points.begin(), a.points.end(), [&](const MeasuredPoint& p) {
    const auto [from, to] = by_time.equal_range(p.point.begin_ns);
    return std::any_of(from, to, [&](const auto& at) { return same_reading(p, *at.second); });
  });
}

}  // namespace

std::string readings_in_common(const Run& a, const Run& b) {
  const std::string& sha256 = a.header.provenance.recording_sha256;
  if (a.header.id != 0 && a.header.id == b.header.id) return name_of(a) + " is given twice";
  if (!sha256.empty() && sha256 == b.header.provenance.recording_sha256)
    return name_of(a) + " and " + name_of(b) + " come from the same recording (" +
           b.header.provenance.recording_path + ")";
  if (continues_from(b, a))
    return name_of(b) + " continues " + name_of(a) + " and contains the readings of " + name_of(a);
  if (continues_from(a, b))
    return name_of(a) + " continues " + name_of(b) + " and contains the readings of " + name_of(b);
  // Imported readings have no times, so they cannot be compared.
  if (!is_imported(a.header) && share_a_reading(a, b))
    return name_of(a) + " and " + name_of(b) + " have readings in common";
  return "";
}

namespace {

Status check_independent(const Run& a, const Run& b) {
  const std::string common = readings_in_common(a, b);
  if (common.empty()) return {};
  return bad_input(common +
                   ": readings that count twice make the uncertainty too small; leave one run out");
}

Status check_one_kind(const Run& a, const Run& b) {
  if (a.header.simulated == b.header.simulated) return {};
  const Run &simulated = a.header.simulated ? a : b, &measured = a.header.simulated ? b : a;
  return bad_input(name_of(simulated) + " is simulated and " + name_of(measured) +
                   " is measured; give only simulated or only measured runs");
}

}  // namespace

Runs all_of(const std::vector<Run>& runs) {
  Runs all;
  for (const Run& run : runs) all.push_back(&run);
  return all;
}

Status check_usable(const Runs& runs, bool take_partial, const std::string& what) {
  for (const Run* run : runs) MDOF_CHECK(check_state(*run, take_partial, what));
  for (std::size_t i = 0; i < runs.size(); ++i)
    for (std::size_t j = 0; j < i; ++j) {
      MDOF_CHECK(check_one_kind(*runs[j], *runs[i]));
      MDOF_CHECK(check_independent(*runs[j], *runs[i]));
    }
  return {};
}

Notices inherited_notices(const Runs& runs) {
  Notices all;
  for (const Run* run : runs) {
    if (run->header.state == RunState::partial)
      all.push_back(notice(NoticeCode::made_from_partial, "", {{"run", run->header.id}}));
    for (const Notice& of_run : run->header.notices)
      all.push_back(inherited(name_of(*run), of_run));
  }
  return all;
}

}  // namespace mdof::algo
