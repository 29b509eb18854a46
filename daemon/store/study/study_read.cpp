// Functions of Store that read studies.
#include "daemon/store/store.h"
#include "schema/base/sha256.h"

namespace mdof::store {

using sqlite::Statement;

namespace {

constexpr std::string_view kStudy =
    "SELECT study.id, name, plan.text, source, settings.text, seed, trials_wanted, fingerprint, "
    "started_utc, software_version FROM study "
    "JOIN document AS plan ON plan.id = study.plan "
    "JOIN document AS settings ON settings.id = study.settings ";

StudyRecord record_of(const Statement& row) {
  StudyRecord study;
  study.id = row.integer(0);
  study.name = row.text(1);
  study.plan_toml = row.text(2);
  study.source = row.text(3);
  study.settings_toml = row.text(4);
  study.seed = row.integer(5);
  if (!row.is_null(6)) study.trials_wanted = row.integer(6);
  study.fingerprint = row.text(7);
  study.started_utc = row.text(8);
  study.software_version = row.text(9);
  return study;
}

std::uint64_t natural(std::int64_t x) {
  return static_cast<std::uint64_t>(x);
}

}  // namespace

Result<StudyRecord> Store::study(std::int64_t id) {
  MDOF_CHECK(check_exists(RowOf::study, id));
  MDOF_TRY(Statement row, connection_.prepare(std::string(kStudy) + "WHERE study.id = ?"));
  MDOF_TRY(const bool found, row.bind(id).step());
  if (found) return record_of(row);
  return bad_input(file().string() + ": study " + std::to_string(id) +
                   " refers to a row that is missing; restore the database from a backup");
}

Result<std::vector<StudyRecord>> Store::list_studies(std::int64_t offset, std::int64_t count) {
  MDOF_TRY(Statement rows,
           connection_.prepare(std::string(kStudy) + "ORDER BY study.id DESC LIMIT ?2 OFFSET ?1"));
  rows.bind(offset).bind(count);
  std::vector<StudyRecord> list;
  for (;;) {
    MDOF_TRY(const bool row, rows.step());
    if (!row) return list;
    list.push_back(record_of(rows));
  }
}

Result<std::int64_t> Store::count_studies() {
  return connection_.integer("SELECT count(*) FROM study");
}

Result<std::optional<StudyOutcome>> Store::study_outcome(std::int64_t study) {
  MDOF_TRY(Statement row,
           connection_.prepare("SELECT state, trials, elapsed_s, ended_utc, software_version, "
                               "figures FROM study_result WHERE study = ? "
                               "ORDER BY id DESC LIMIT 1"));
  MDOF_TRY(const bool found, row.bind(study).step());
  if (!found) return std::optional<StudyOutcome>();
  return std::optional(StudyOutcome{row.text(0) == to_string(StudyState::complete)
                                        ? StudyState::complete
                                        : StudyState::interrupted,
                                    natural(row.integer(1)), row.real(2), std::string(row.text(3)),
                                    std::string(row.text(4)), std::string(row.text(5))});
}

Result<std::optional<StudyCheckpoint>> Store::study_checkpoint(std::int64_t study) {
  MDOF_TRY(Statement row, connection_.prepare("SELECT trials, sha256, bytes FROM study_checkpoint "
                                              "WHERE study = ?"));
  MDOF_TRY(const bool found, row.bind(study).step());
  if (!found) return std::optional<StudyCheckpoint>();
  StudyCheckpoint checkpoint{natural(row.integer(0)), std::string(row.bytes(2))};
  if (sha256_hex(checkpoint.bytes) == row.text(1)) return std::optional(std::move(checkpoint));
  return bad_input(file().string() + ": the checkpoint of study " + std::to_string(study) +
                   " is damaged; run the study again with its seed");
}

Status Store::verify_studies(std::vector<std::string>& findings) {
  MDOF_TRY(Statement rows,
           connection_.prepare("SELECT study, figures, figures_sha256 FROM study_result"));
  for (;;) {
    MDOF_TRY(const bool row, rows.step());
    if (!row) break;
    if (sha256_hex(rows.text(1)) != rows.text(2))
      findings.push_back("the figures of study " + std::to_string(rows.integer(0)) +
                         " were changed after they were stored; run the study again");
  }
  MDOF_TRY(Statement checkpoints, connection_.prepare("SELECT study FROM study_checkpoint"));
  for (;;) {
    MDOF_TRY(const bool row, checkpoints.step());
    if (!row) return {};
    const auto whole = study_checkpoint(checkpoints.integer(0));
    if (!whole) findings.push_back(whole.error().message);
  }
}

}  // namespace mdof::store
